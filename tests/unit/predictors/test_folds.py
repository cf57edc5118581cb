"""Folds over images."""

import numpy as np
import pandas as pd
import pytest

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.folds import FOLD_SCHEMA, split
from grasptypes.predictors.members import members_by_group
from grasptypes.predictors.variants import VARIANTS
from grasptypes.seeds import rng
from grasptypes.settings.predictors import NO_TASK

VIEWS = {"apple": 13, "mug": 10, "pan": 11}
TASKS = ["use", "handoff", "show"]


def test_every_picture_is_tested_once_and_every_fold_has_its_share():
    folds = FOLD_SCHEMA.validate(split(VIEWS, 5, seed=0))
    assert folds.groupby("object").size().to_dict() == VIEWS
    shares = folds.groupby(["object", "fold"]).size().unstack()
    assert (shares.max(axis=1) - shares.min(axis=1) <= 1).all()
    whole = folds.groupby("fold").size()
    assert whole.max() - whole.min() <= 1


def test_folds_of_an_object_do_not_depend_on_the_others():
    alone = split({"mug": 10}, 5, seed=0).sort_values("view")["fold"].to_numpy()
    among = split(VIEWS, 5, seed=0).query("object == 'mug'").sort_values("view")["fold"].to_numpy()
    np.testing.assert_array_equal((among - alone) % 5, (among - alone)[0] % 5)


@pytest.mark.parametrize("model", VARIANTS)
def test_no_picture_is_in_train_and_test(model):
    rng = np.random.default_rng(0)
    encodings = [NO_TASK, *TASKS]
    features = {
        name: {e: rng.random((count, 3), dtype=np.float32) for e in encodings}
        for name, count in VIEWS.items()
    }
    counts = [
        {"object": name, "task": task, **dict.fromkeys(COUNTS, 1)}
        for name in VIEWS
        for task in TASKS
    ]
    samples = samples_from_counts(pd.DataFrame(counts))
    folds = split(VIEWS, 5, seed=0)
    examples = assemble(VARIANTS[model], features, samples, folds, TASKS)
    pictures = examples.index[["object", "view"]].apply(tuple, axis=1)
    for member in members_by_group(examples.index["fold"], seeds=2):
        assert not set(pictures[member.train]) & set(pictures[member.test])
        assert len(member.train) + len(member.test) == len(pictures)
    per_picture = examples.index.groupby(["object", "view"])["fold"].nunique()
    assert (per_picture == 1).all()


def test_as_many_folds_as_pictures_leave_one_picture_out():
    assert split({"mug": 10}, 10, seed=0)["fold"].nunique() == 10


def test_more_folds_than_pictures():
    with pytest.raises(InputError) as caught:
        split(VIEWS, 11, seed=0)
    expected = "params.yaml: folds.count: 11 folds need at least as many views; mug has 10"
    assert str(caught.value) == expected


def test_rows_are_in_order_and_the_seed_and_the_object_decide_who_is_where():
    folds = split(VIEWS, 5, seed=0)
    assert list(folds.columns) == ["object", "view", "fold"]
    assert folds.index.tolist() == list(range(sum(VIEWS.values())))
    ordered = folds.sort_values(["object", "view"])
    pd.testing.assert_frame_equal(folds, ordered)
    pd.testing.assert_frame_equal(folds, split(VIEWS, 5, seed=0))
    assert not folds["fold"].equals(split(VIEWS, 5, seed=1)["fold"])
    order = rng("folds", "mug", 0).permutation(10)
    alone = split({"mug": 10}, 5, seed=0).set_index("view")["fold"]
    assert alone[order].tolist() == [0, 1, 2, 3, 4, 0, 1, 2, 3, 4]
