"""Families and their relatives are left out together, and what is left is learned."""

import numpy as np
import pytest

from grasptypes.errors import InputError
from grasptypes.segmentation.folds import family_folds, learned_rows, object_fold

FAMILIES = np.array(["cup", "knife", "cup", "ball", "spoon", "knife", "bowl"])
KEY = ("test", 0)


def test_a_family_is_left_out_together():
    folds = family_folds(FAMILIES, 3, KEY)
    assert set(folds) == {0, 1, 2}
    assert folds[0] == folds[2]
    assert folds[1] == folds[5]


def test_relatives_share_a_fold_even_through_others():
    for number in range(20):
        folds = family_folds(FAMILIES, 3, ("test", number), [["cup", "ball"], ["ball", "bowl"]])
        assert len(set(folds[[0, 3, 6]])) == 1


def test_a_fold_learns_from_all_others():
    rows, key = learned_rows(FAMILIES, 1, 3, 0)
    left_out = np.setdiff1d(np.arange(len(FAMILIES)), rows)
    assert 0 < len(left_out) < len(FAMILIES)
    assert not set(FAMILIES[left_out]) & set(FAMILIES[rows])
    everything, whole_key = learned_rows(FAMILIES, None, 3, 0)
    assert len(everything) == len(FAMILIES)
    assert key != whole_key


def test_an_object_whose_families_are_apart_has_no_fold():
    assert object_fold("mug", ["cup", "bowl", "unknown"], {"cup": 2, "bowl": 2, "ball": 0}) == 2
    with pytest.raises(InputError, match=r"families\.mug: spans several folds"):
        object_fold("mug", ["cup", "ball"], {"cup": 2, "ball": 0})
