"""Counts become labels and probability vectors."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from grasptypes.errors import InputError
from grasptypes.labels.samples import (
    COUNT_SCHEMA,
    COUNTS,
    LABELS,
    PROBABILITIES,
    labels_of,
    samples_from_counts,
)

PUBLISHED = Path(__file__).parents[3] / "assets" / "published_labels.csv"


def counts(**rows: list[int]) -> pd.DataFrame:
    names = [name.split("__") for name in rows]
    table = pd.DataFrame(list(rows.values()), columns=list(COUNTS))
    return table.assign(object=[n[0] for n in names], task=[n[1] for n in names])


def test_label_and_probability_of_a_count_vector():
    sample = samples_from_counts(counts(mug__use=[0, 3, 0, 1, 0, 0])).iloc[0]
    assert sample["n_valid"] == 4
    np.testing.assert_array_equal(sample[list(LABELS)], [0, 1, 0, 1, 0, 0])
    np.testing.assert_array_equal(sample[list(PROBABILITIES)], [0, 0.5, 0, 0.5, 0, 0])


def test_without_a_valid_grasp_there_is_no_label():
    with pytest.raises(InputError, match=r"file\.csv: mug, use"):
        samples_from_counts(counts(mug__use=[0] * 6), "file.csv")


def test_published_counts_have_the_papers_figures():
    published = COUNT_SCHEMA.validate(pd.read_csv(PUBLISHED))
    assert published[list(COUNTS)].sum().tolist() == [52, 59, 144, 197, 103, 139]
    labels = labels_of(samples_from_counts(published))
    assert labels.shape == (19, 2, 6)
    assert labels.sum(axis=-1).mean() == pytest.approx(3.5, abs=0.005)  # paper, section III-C
    assert (labels[:, 0] != labels[:, 1]).sum(axis=-1).mean() == pytest.approx(1.1, abs=0.01)


def test_a_missing_task_is_not_passed_over():
    table = samples_from_counts(counts(mug__use=[1] * 6, mug__handoff=[1] * 6, cup__use=[1] * 6))
    with pytest.raises(ValueError, match="every object"):
        labels_of(table)
