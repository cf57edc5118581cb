"""Distributions of types compared."""

import pandas as pd
import pytest

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.reports.distribution import DISTRIBUTION_SCHEMA, compare_distributions, describe


def counts(rows):
    return pd.DataFrame(rows, columns=["object", "task", *COUNTS])


OURS = counts([["mug", "use", 4, 0, 0, 0, 0, 0], ["mug", "handoff", 0, 0, 0, 3, 0, 3]])
THEIRS = counts(
    [
        ["mug", "use", 2, 0, 0, 0, 0, 0],
        ["mug", "handoff", 0, 0, 0, 1, 0, 0],
        ["pan", "use", 0, 0, 0, 1, 0, 0],
    ]
)


def test_similarity_by_row_and_mean():
    table = compare_distributions(samples_from_counts(OURS), THEIRS)
    DISTRIBUTION_SCHEMA.validate(table)
    assert table.object.tolist() == ["mug", "mug", "mean"]
    # 45 degrees are half of the right angle at which nothing is alike.
    assert table.similarity.tolist() == [0.5, 1.0, 0.75]
    assert table.resampled.tolist() == [1, 1, 1]  # of one type each


def test_chance_is_what_as_many_draws_differ_by():
    theirs = THEIRS[THEIRS.object == "pan"].assign(object="mug", task="use", count_large_wrap=1)
    table = compare_distributions(samples_from_counts(OURS), theirs)
    # Two draws of two types: half of them have both, the others are 45 degrees off.
    assert table.resampled[0] == pytest.approx(0.75, abs=0.03)


def test_no_common_sample_is_refused():
    with pytest.raises(InputError, match="samples here"):
        compare_distributions(samples_from_counts(OURS), THEIRS[THEIRS.object == "pan"])


def test_types_per_sample_and_between_tasks():
    assert describe(OURS) == (1.5, 3.0)
