"""The table of samples: the grasp types of each object and task.

It has the same form for simulated and published labels, so that everything after it works with
both.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.errors import InputError
from grasptypes.tables import read_table

# Spelled and ordered as in the published table.
TYPES = (
    "large_wrap",
    "medium_wrap",
    "small_wrap",
    "power_sphere",
    "precision_sphere",
    "precision",
)
COUNTS = tuple(f"count_{name}" for name in TYPES)
LABELS = tuple(f"label_{name}" for name in TYPES)
PROBABILITIES = tuple(f"probability_{name}" for name in TYPES)

COUNT_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        **{name: pa.Column(int, pa.Check.ge(0)) for name in COUNTS},
    },
    strict=True,
    unique=["object", "task"],
)
SAMPLE_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        "n_valid": pa.Column(int, pa.Check.ge(1)),
        **{name: pa.Column(int, pa.Check.ge(0)) for name in COUNTS},
        **{name: pa.Column(float, pa.Check.in_range(0, 1)) for name in PROBABILITIES},
        **{name: pa.Column(int, pa.Check.isin([0, 1])) for name in LABELS},
    },
    strict=True,
    unique=["object", "task"],
)


def samples_from_counts(counts: pd.DataFrame, file: str | Path = "counts") -> pd.DataFrame:
    """The binary label and the probability vector of every count vector.

    The label marks all types that occur (paper, section III-C). The probability vector is the label
    divided by its number of types: this gives the published labels a task-blind ceiling of 0.849,
    which the paper's row (a) nearly reaches; count frequencies would give 0.885.

    Args:
        counts: columns ``object``, ``task`` and the six of :data:`COUNTS`.
        file: file name for errors.

    Returns:
        a table of :data:`SAMPLE_SCHEMA`, sorted by object and task.

    Raises:
        InputError: an (object, task) without a single valid grasp.
    """
    counts = counts.sort_values(["object", "task"], ignore_index=True)
    numbers = counts[list(COUNTS)].to_numpy(dtype=int)
    empty = counts[numbers.sum(axis=1) == 0]
    if len(empty):
        first = empty.iloc[0]
        raise InputError(file, f"{first['object']}, {first['task']}", "has no valid grasp")
    labels = (numbers > 0).astype(int)
    probabilities = labels / labels.sum(axis=1, keepdims=True)
    columns = {"n_valid": numbers.sum(axis=1)}
    for names, values in ((COUNTS, numbers), (PROBABILITIES, probabilities), (LABELS, labels)):
        columns |= dict(zip(names, values.T, strict=True))
    return counts[["object", "task"]].assign(**columns)


def read_samples(path: str | Path) -> pd.DataFrame:
    """Read and check a table of samples."""
    return read_table(path, SAMPLE_SCHEMA)


def labels_of(samples: pd.DataFrame) -> np.ndarray:
    """(objects, tasks, 6) truth values, objects and tasks in alphabetical order.

    Raises:
        ValueError: an object lacks a task that another has.
    """
    objects, tasks = sorted(set(samples["object"])), sorted(set(samples["task"]))
    table = samples.set_index(["object", "task"])
    full = pd.MultiIndex.from_product([objects, tasks])
    if len(table) != len(full) or not table.index.isin(full).all():
        raise ValueError("every object needs a sample for every task")
    labels: np.ndarray = table.loc[full, list(LABELS)].to_numpy(dtype=bool)
    return labels.reshape(len(objects), len(tasks), len(TYPES))
