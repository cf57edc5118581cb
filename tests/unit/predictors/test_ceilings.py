"""The reference predictors, by hand and on the published labels."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from grasptypes.labels.samples import labels_of, samples_from_counts
from grasptypes.predictors.ceilings import ceilings

PUBLISHED = Path(__file__).parents[3] / "assets" / "published_labels.csv"


def test_labels_without_a_task_leave_no_ceiling_below_one():
    labels = np.array([[[1, 0, 0]] * 2, [[0, 1, 1]] * 2], dtype=bool)
    assert ceilings(labels).loc["task_blind"].tolist() == pytest.approx([1, 1, 1])


def test_one_object_by_hand():
    table = ceilings(np.array([[[1, 0], [0, 1]]], dtype=bool))
    # The vector half-way between orthogonal ones is 45 degrees from both; any set is half right.
    assert table.loc["task_blind", "angular_similarity"] == pytest.approx(0.5)
    assert table.loc["task_blind", "multilabel_accuracy"] == pytest.approx(0.5)
    assert table.loc["all_types"].tolist() == pytest.approx([0.5, 0.5, 0.5])


def test_published_labels():
    table = ceilings(labels_of(samples_from_counts(pd.read_csv(PUBLISHED))))
    expected = {"task_blind": (0.849, 0.870), "best_constant": (0.635, 0.648)}
    expected["all_types"] = (0.555, 0.583)
    for name, values in expected.items():
        assert table.loc[name].iloc[:2].tolist() == pytest.approx(values, abs=0.0006)
