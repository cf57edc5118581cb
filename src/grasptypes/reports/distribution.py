"""How often each grasp type occurs for an object and a task: ours beside the published counts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS
from grasptypes.predictors.metrics import angular_similarity

MEAN = "mean"
PUBLISHED = tuple(f"published_{name}" for name in COUNTS)

DISTRIBUTION_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        **{name: pa.Column(float, pa.Check.ge(0)) for name in (*COUNTS, *PUBLISHED)},
        "similarity": pa.Column(float, pa.Check.in_range(0, 1)),
    },
    strict=True,
    ordered=True,
    unique=["object", "task"],
)


def compare_distributions(
    samples: pd.DataFrame, published: pd.DataFrame, file: str | Path = "published labels"
) -> pd.DataFrame:
    """Angular similarity of our counts and the published ones, the mean in the last row.

    Args:
        samples: of `samples.SAMPLE_SCHEMA`.
        published: of `samples.COUNT_SCHEMA`.
        file: named in errors.

    Returns:
        A table of `DISTRIBUTION_SCHEMA`, a row for each (object, task) that both tables have.

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
    numbers = [*COUNTS, *PUBLISHED, "similarity"]
    mean = {"object": MEAN, "task": MEAN, **table[numbers].mean().round(4).to_dict()}
    table = pd.concat([table, pd.DataFrame([mean])], ignore_index=True)
    return table.astype(dict.fromkeys(numbers, float))[list(DISTRIBUTION_SCHEMA.columns)]


def describe(counts: pd.DataFrame) -> tuple[float, float]:
    """Types per (object, task), and types that differ between an object's two tasks, both means.

    The paper has 3.5 and 1.1. A type differs if it occurs for one task only.

    Args:
        counts: columns object, task and those of `samples.COUNTS`.
    """
    occurs = counts.set_index(["object", "task"])[list(COUNTS)] > 0
    tasks = occurs.groupby("object").agg(["min", "max"])
    differ = [
        int((tasks[(name, "min")] != tasks[(name, "max")])[row])
        for name in COUNTS
        for row in tasks.index
    ]
    return float(occurs.sum(axis=1).mean()), float(np.sum(differ) / len(tasks))
