"""Folds share out images evenly, whatever the objects; random numbers follow their key."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from grasptypes.predictors.folds import FOLD_SCHEMA, split
from grasptypes.seeds import rng, seed

NAMES = st.sampled_from(["apple", "bowl", "cup", "mug", "pan"])
KEYS = st.lists(st.one_of(st.text(max_size=5), st.integers(0, 99)), min_size=1, max_size=3)


@st.composite
def problems(draw):
    """Views by object, a number of folds that they allow, and a seed."""
    folds = draw(st.integers(2, 6))
    views = draw(st.dictionaries(NAMES, st.integers(folds, 20), min_size=1))
    return views, folds, draw(st.integers(0, 3))


@given(problems())
def test_every_picture_lies_in_one_fold_and_folds_are_even(problem):
    views, folds, number = problem
    table = FOLD_SCHEMA.validate(split(views, folds, number))
    assert table.groupby("object").view.apply(sorted).to_dict() == {
        name: list(range(count)) for name, count in views.items()
    }
    for group in (*(rows for _, rows in table.groupby("object")), table):
        sizes = np.bincount(group.fold, minlength=folds)
        assert len(sizes) == folds
        assert sizes.max() - sizes.min() <= 1


@given(problems())
def test_the_order_in_which_objects_are_named_does_not_count(problem):
    views, folds, number = problem
    backwards = dict(reversed(list(views.items())))
    assert split(views, folds, number).equals(split(backwards, folds, number))


@given(KEYS, KEYS)
def test_equal_keys_draw_equal_numbers_and_others_do_not(first, second):
    assert (seed(*first) == seed(*second)) == (first == second)
    assert 0 <= seed(*first) < 2**63
    assert rng(*first).random() == rng(*first).random()
