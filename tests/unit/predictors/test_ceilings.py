"""The reference predictors, by hand and on the published labels."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from grasptypes.labels.samples import COUNTS, labels_of, samples_from_counts
from grasptypes.predictors.ceilings import ceilings, constant_of_others

PUBLISHED = Path(__file__).parents[3] / "assets" / "published_labels.csv"


def test_labels_without_a_task_leave_no_ceiling_below_one():
    labels = np.array([[[1, 0, 0]] * 2, [[0, 1, 1]] * 2], dtype=bool)
    assert ceilings(labels).loc["task_blind"].tolist() == pytest.approx([1, 1, 1, 1])


def test_one_object_by_hand():
    table = ceilings(np.array([[[1, 0], [0, 1]]], dtype=bool))
    # The vector half-way between orthogonal ones is 45 degrees from both; any set is half right.
    assert table.loc["task_blind", "angular_similarity"] == pytest.approx(0.5)
    assert table.loc["task_blind", "multilabel_accuracy"] == pytest.approx(0.5)
    assert table.loc["all_types"].tolist() == pytest.approx([0.5, 0.5, 0.5, 0.5])


def test_frequencies_have_an_answer_of_their_own():
    # Three of four grasps are of the first type for one task, all four for the other.
    table = ceilings(np.array([[[3, 1], [4, 0]]]))
    angle = np.arctan(1 / 3)  # between the frequencies, halved by the best answer
    blind = table.loc["task_blind"]
    assert blind["frequency_similarity"] == pytest.approx(1 - angle / np.pi)
    assert blind["angular_similarity"] == pytest.approx(0.75)  # of the sets: 45 degrees, halved
    uniform = 1 - 2 / np.pi * np.mean([np.pi / 4 - angle, np.pi / 4])
    assert table.loc["all_types", "frequency_similarity"] == pytest.approx(uniform)


def test_each_measure_has_its_own_best_set():
    # The first type always occurs, the others in turn: both of two are better than the first alone.
    labels = np.array([[[1, 1, 1, 0], [1, 1, 0, 1]]], dtype=bool)
    best = ceilings(labels).loc["best_constant"]
    assert best["multilabel_accuracy"] == pytest.approx(3 / 4)  # of all four types
    assert best["multilabel_precision"] == pytest.approx(1)  # of the first


def test_published_labels():
    table = ceilings(labels_of(samples_from_counts(pd.read_csv(PUBLISHED))))
    expected = {"task_blind": (0.849, 0.870), "best_constant": (0.635, 0.648)}
    expected["all_types"] = (0.555, 0.583)
    for name, values in expected.items():
        assert table.loc[name].iloc[:2].tolist() == pytest.approx(values, abs=0.0006)


def samples(types):
    """A table of samples: (object, task) to the places of its types."""
    counts = [[int(place in found) for place in range(6)] for found in types.values()]
    names = pd.DataFrame(list(types), columns=["object", "task"])
    return samples_from_counts(
        pd.concat([names, pd.DataFrame(counts, columns=list(COUNTS))], axis=1)
    )


def test_the_constant_of_the_others_does_not_know_the_object_left_out():
    known = {("bowl", "use"): [0], ("cup", "use"): [0], ("mug", "use"): [0], ("pan", "use"): [1]}
    table = constant_of_others(samples(known), joint=False)
    assert table.loc["pan"].tolist() == pytest.approx([0, 0, 0, 0])  # nobody else has type 1
    # The mean of two of type 0 and one of type 1 is at an angle of atan(1/2) from type 0.
    third = 1 - 2 / np.pi * np.arctan(1 / 2)
    assert table.loc["mug"].tolist() == pytest.approx([third, 1, 1, third])
    assert list(table.index) == ["bowl", "cup", "mug", "pan"]
    everything = ceilings(labels_of(samples(known))).loc["best_constant", "angular_similarity"]
    assert table["angular_similarity"].mean() < everything


def test_the_constant_of_the_others_knows_no_variant_of_the_object_either():
    known = {("mug", "use"): [0], ("mug_v01", "use"): [0], ("pan", "use"): [1]}
    table = constant_of_others(samples(known), joint=False)
    assert table["angular_similarity"].to_dict() == pytest.approx({"mug": 0, "pan": 0})


def test_joint_labels_have_a_constant_of_the_others_of_their_own():
    known = {
        (name, task): [place]
        for name in ("mug", "pan")
        for place, task in enumerate(("use", "handoff"))
    }
    apart = constant_of_others(samples(known), joint=False)["angular_similarity"]
    assert apart.tolist() == pytest.approx([0.5, 0.5])  # between two types at right angles
    joint = constant_of_others(samples(known), joint=True)["angular_similarity"]
    assert joint.tolist() == pytest.approx([1, 1])  # both types, for both tasks
