"""The paper's analysis of the labels: types of a pair, what tasks change, and label noise."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.labels.samples import COUNTS
from grasptypes.predictors.metrics import angular_similarity
from grasptypes.seeds import rng

# Number of draws at which the means over objects are stable in their third digit.
DRAWS = 1000
# The paper's numbers: types of an object and task, and types that differ between its tasks. The
# published labels have 3.50 and 1.11, so this is what its second number means.
PAPER = {"types": 3.5, "differing": 1.1}
_SHARE = pa.Check.in_range(0, 1)
ANALYSIS_SCHEMA = pa.DataFrameSchema(
    {
        "labels": pa.Column(str),
        "object": pa.Column(str),
        "types": pa.Column(float, pa.Check.ge(0), description="types of a task, mean of the tasks"),
        "shared": pa.Column(float, pa.Check.ge(0), description="types that all tasks have"),
        "differing": pa.Column(float, pa.Check.ge(0), description="types that some tasks have"),
        "task_similarity": pa.Column(float, _SHARE, description="of two tasks' type frequencies"),
        "chance_similarity": pa.Column(
            float, _SHARE, description="the same if sessions are dealt to the tasks at random"
        ),
        "noise_sets": pa.Column(
            float, _SHARE, description="of sets of types and those of sessions drawn again"
        ),
        "noise_frequencies": pa.Column(float, _SHARE, description="likewise, of frequencies"),
    },
    strict=True,
    ordered=True,
    unique=["labels", "object"],
)


def analyse(samples: pd.DataFrame, labels: str) -> pd.DataFrame:
    """The analysis of a label source.

    Sessions are drawn again with replacement, as many as there are (bootstrap). Sets of types can
    only become smaller that way, so `noise_sets` is a lower bound on the ceiling that label noise
    sets for a predictor.

    Args:
        samples: of `samples.SAMPLE_SCHEMA`, with two tasks or more.
        labels: name of the label source.

    Returns:
        a table of `ANALYSIS_SCHEMA`, one row per object.
    """
    rows = []
    for name, group in samples.sort_values("task").groupby("object", sort=True):
        counts = group[list(COUNTS)].to_numpy()
        draw = rng("task_analysis", labels, str(name))
        sets, frequencies = zip(*(_noise(one, draw) for one in counts), strict=True)
        similar, chance = zip(*(_pair(*two, draw) for two in combinations(counts, 2)), strict=True)
        occurs = counts > 0
        shared = occurs.all(axis=0).sum()
        numbers = (
            occurs.sum(axis=1).mean(),
            shared,
            occurs.any(axis=0).sum() - shared,
            *(np.mean(values) for values in (similar, chance, sets, frequencies)),
        )
        rows.append((labels, str(name), *(round(float(number), 4) for number in numbers)))
    return pd.DataFrame(rows, columns=list(ANALYSIS_SCHEMA.columns))


def share_changes(samples: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """How a task changes the distribution of types, object by object.

    Args:
        samples: of `samples.SAMPLE_SCHEMA`.

    Returns:
        "task - reference" to share of sessions minus that of the reference: index object, columns
        as in `samples.COUNTS`. The reference is the last task by name (*use* of the paper's two).
    """
    counts = samples.set_index(["task", "object"]).sort_index()[list(COUNTS)]
    shares = counts.div(counts.sum(axis=1), axis=0)
    *others, reference = sorted(set(samples["task"]))
    return {f"{task} - {reference}": shares.loc[task] - shares.loc[reference] for task in others}


def _noise(counts: np.ndarray, draw: np.random.Generator) -> tuple[float, float]:
    """Mean similarity of counts (K,) and those of sessions drawn again: as sets, as frequencies."""
    again = draw.multinomial(int(counts.sum()), counts / counts.sum(), DRAWS)
    sets = angular_similarity(again > 0, counts > 0).mean()
    return float(sets), float(angular_similarity(again, counts).mean())


def _pair(first: np.ndarray, second: np.ndarray, draw: np.random.Generator) -> tuple[float, float]:
    """Similarity of two tasks' counts (K,), and its mean if their sessions are mixed."""
    both = first + second
    dealt = draw.multivariate_hypergeometric(both, int(first.sum()), DRAWS)
    chance = angular_similarity(dealt, both - dealt).mean()
    return float(angular_similarity(first, second)), float(chance)
