"""Each measure by hand, and where it degenerates."""

import numpy as np
import pytest

from grasptypes.predictors.metrics import (
    angular_similarity,
    chosen,
    evaluate,
    multilabel_accuracy,
    multilabel_precision,
)


@pytest.mark.parametrize(
    ("predicted", "target", "expected"),
    [
        ([1, 0, 0], [1, 0, 0], 1.0),
        ([1, 0, 0], [0, 0, 1], 0.0),
        ([1, 0, 0], [1, 1, 0], 0.5),  # 45 degrees of 90
        ([1, 1, 1], [1, 1, 0], 1 - 2 / np.pi * np.arccos(2 / np.sqrt(6))),
        ([2, 4, 6], [1, 2, 3], 1.0),  # length does not count
    ],
)
def test_similarity_is_the_share_of_a_right_angle_that_is_left(predicted, target, expected):
    assert angular_similarity(predicted, target) == pytest.approx(expected, abs=1e-12)


def test_similarity_keeps_its_digits_at_small_angles():
    assert 1 - angular_similarity([1, 0], [np.cos(1e-9), np.sin(1e-9)]) == pytest.approx(
        2e-9 / np.pi, rel=1e-6
    )


@pytest.mark.parametrize(
    ("vector", "needed"),
    [
        ([0, 0, 0], "vectors that are not all zeros"),
        ([[1, 0, 0], [0, 0, 0]], "vectors that are not all zeros"),
        ([1, -1, 0], "finite, non-negative vectors"),
        ([np.nan, 1, 0], "finite, non-negative vectors"),
        ([np.inf, 1, 0], "finite, non-negative vectors"),
    ],
)
def test_similarity_needs_a_direction_without_negative_parts(vector, needed):
    with pytest.raises(ValueError, match=f"^angular similarity needs {needed}$"):
        angular_similarity([1, 0, 0], vector)


@pytest.mark.parametrize(
    ("predicted", "target", "accuracy", "precision"),
    [
        ([1, 1, 0], [1, 1, 0], 1.0, 1.0),
        ([1, 1, 0], [0, 1, 1], 1 / 3, 1 / 2),
        ([1, 1, 1], [1, 0, 0], 1 / 3, 1 / 3),
        ([1, 0, 0], [1, 1, 1], 1 / 3, 1.0),
        ([0, 0, 0], [1, 0, 0], 0.0, 0.0),  # nothing predicted
        ([0, 0, 0], [0, 0, 0], 1.0, 1.0),  # nothing to predict either
        ([0, 1, 0], [0, 1, 0], 1.0, 1.0),  # a single type
    ],
)
def test_sets_are_compared_by_their_overlap(predicted, target, accuracy, precision):
    assert multilabel_accuracy(predicted, target) == pytest.approx(accuracy)
    assert multilabel_precision(predicted, target) == pytest.approx(precision)


def test_a_type_is_chosen_when_its_sigmoid_exceeds_one_half():
    np.testing.assert_array_equal(chosen([-1e-9, 0.0, 1e-9]), [False, False, True])


def test_any_truth_value_counts_as_one_type():
    assert multilabel_accuracy([2, 1, 0], [1, 2, 0]) == 1.0
    assert multilabel_precision([0.5, 0, 4], [1, 0, 0]) == 0.5


@pytest.mark.parametrize("measure", [angular_similarity, multilabel_accuracy, multilabel_precision])
def test_many_samples_are_measured_like_one(measure):
    rng = np.random.default_rng(0)
    predicted, target = rng.integers(0, 3, (2, 4, 5, 3))
    predicted[..., 0] += 1
    target[..., 1] += 1
    values = measure(predicted, target)
    assert values.shape == (4, 5)
    for index in np.ndindex(values.shape):
        assert values[index] == pytest.approx(float(measure(predicted[index], target[index])))


def test_evaluation_averages_over_samples():
    logits = np.array([[9.0, -9.0], [9.0, 9.0]])
    labels = np.array([[1, 0], [1, 0]])
    values = evaluate(logits, labels, [[1, 1], [1, 3]])
    assert values["multilabel_accuracy"] == pytest.approx(0.75)
    assert values["multilabel_precision"] == pytest.approx(0.75)
    assert values["angular_similarity"] == pytest.approx(0.75, abs=1e-6)
    beside = np.arctan(3) - np.pi / 4  # of the second, whose first type is a quarter of the grasps
    frequency = 1 - 2 / np.pi * np.mean([np.pi / 4, beside])
    assert values["frequency_similarity"] == pytest.approx(frequency, abs=1e-6)
