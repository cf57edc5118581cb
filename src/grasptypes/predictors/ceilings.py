"""What predictors that know less than the picture and the task can reach with given labels."""

from __future__ import annotations

from itertools import product

import numpy as np
import pandas as pd

from grasptypes.predictors.metrics import (
    METRICS,
    angular_similarity,
    multilabel_accuracy,
    multilabel_precision,
)

CEILINGS = ("task_blind", "best_constant", "all_types")


def ceilings(labels: np.ndarray) -> pd.DataFrame:
    """The three reference predictors.

    ``task_blind`` knows the object but not the task, ``best_constant`` gives one answer for
    everything, ``all_types`` answers all types. Vectors are the mean of the unit label vectors. For
    two samples no other vector is more similar to both. For more it has the largest mean cosine,
    not the largest mean angular similarity, so the similarity of ``best_constant``, and that of
    ``task_blind`` with three tasks or more, is only a lower bound of the best there is. Sets are
    those of the best accuracy; the precision is theirs, another set may have a better one.

    Args:
        labels: (objects, tasks, K) truth values.

    Returns:
        index :data:`CEILINGS`, columns the three measures of :mod:`grasptypes.predictors.metrics`.
    """
    everything = labels.reshape(1, -1, labels.shape[-1])
    rows = {
        "task_blind": _best(labels),
        "best_constant": _best(everything),
        "all_types": _scores(
            labels, np.ones(labels.shape[-1]), np.ones(labels.shape[-1], dtype=bool)
        ),
    }
    return pd.DataFrame.from_dict(rows, orient="index", columns=list(METRICS))


def _best(groups: np.ndarray) -> tuple[float, float, float]:
    """One answer for each group of samples, see :func:`ceilings`: groups (G, N, K) truth values."""
    units = groups / np.linalg.norm(groups, axis=-1, keepdims=True)
    candidates = np.array(list(product([False, True], repeat=groups.shape[-1]))[1:])
    accuracy = multilabel_accuracy(candidates[:, None, None], groups).mean(axis=-1)
    sets = candidates[accuracy.argmax(axis=0)]
    return _scores(groups, units.mean(axis=1, keepdims=True), sets[:, None])


def _scores(
    labels: np.ndarray, vector: np.ndarray, types: np.ndarray
) -> tuple[float, float, float]:
    return (
        float(angular_similarity(vector, labels.astype(float)).mean()),
        float(multilabel_accuracy(types, labels).mean()),
        float(multilabel_precision(types, labels).mean()),
    )
