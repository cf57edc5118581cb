"""Grasp-type counts for each object and task: ours and the published ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS
from grasptypes.predictors.metrics import angular_similarity
from grasptypes.seeds import rng

MEAN = "mean"
# Number of draws at which the mean over (object, task) is stable in its third digit.
RESAMPLES = 1000
PUBLISHED = tuple(f"published_{name}" for name in COUNTS)

DISTRIBUTION_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        **{name: pa.Column(float, pa.Check.ge(0)) for name in (*COUNTS, *PUBLISHED)},
        "similarity": pa.Column(float, pa.Check.in_range(0, 1)),
        "resampled": pa.Column(
            float,
            pa.Check.in_range(0, 1),
            description="of as many draws from the published ones: what chance allows",
        ),
    },
    strict=True,
    ordered=True,
    unique=["object", "task"],
)


def compare_distributions(
    samples: pd.DataFrame, published: pd.DataFrame, file: str | Path = "published labels"
) -> pd.DataFrame:
    """Angular similarity of our counts and the published ones, with the mean in the last row.

    Args:
        samples: of `samples.SAMPLE_SCHEMA`.
        published: of `samples.COUNT_SCHEMA`.
        file: file name for errors.

    Returns:
        A table of `DISTRIBUTION_SCHEMA`, one row per (object, task) in both tables.

    Raises:
        InputError: the tables have no (object, task) in common.
    """
    keys = ["object", "task"]
    theirs = published.rename(columns=dict(zip(COUNTS, PUBLISHED, strict=True)))
    table = samples[[*keys, *COUNTS]].merge(theirs, on=keys).sort_values(keys, ignore_index=True)
    if table.empty:
        raise InputError(file, "object, task", "none of them has samples here")
    ours, published_counts = (table[list(names)].to_numpy(float) for names in (COUNTS, PUBLISHED))
    table["similarity"] = angular_similarity(ours, published_counts).round(4)
    table["resampled"] = [
        _resampled(counts, rng("resampled", *name))
        for counts, name in zip(published_counts, table[keys].itertuples(index=False), strict=True)
    ]
    numbers = [*COUNTS, *PUBLISHED, "similarity", "resampled"]
    mean = {"object": MEAN, "task": MEAN, **table[numbers].mean().round(4).to_dict()}
    table = pd.concat([table, pd.DataFrame([mean])], ignore_index=True)
    return table.astype(dict.fromkeys(numbers, float))[list(DISTRIBUTION_SCHEMA.columns)]


def _resampled(counts: np.ndarray, draw: np.random.Generator) -> float:
    """Mean angular similarity of counts (K,) and equally many draws from their shares."""
    drawn = draw.multinomial(int(counts.sum()), counts / counts.sum(), RESAMPLES)
    return round(float(angular_similarity(drawn, counts).mean()), 4)


def describe(counts: pd.DataFrame) -> tuple[float, float]:
    """Mean number of types per (object, task), and of types that differ between the two tasks.

    The paper has 3.5 and 1.1. A type differs if it occurs for only one task.

    Args:
        counts: columns object, task and those of `samples.COUNTS`.
    """
    occurs = counts.set_index(["object", "task"])[list(COUNTS)] > 0
    tasks = occurs.groupby("object")
    differ = (tasks.min() != tasks.max()).sum(axis=1)
    return float(occurs.sum(axis=1).mean()), float(differ.mean())
