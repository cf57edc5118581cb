"""Scores that predictors without the image or the task can reach with given labels."""

from __future__ import annotations

from itertools import product

import numpy as np
import pandas as pd

from grasptypes.labels.samples import COUNTS, labels_of
from grasptypes.predictors.members import members_by_object
from grasptypes.predictors.metrics import (
    METRICS,
    angular_similarity,
    multilabel_accuracy,
    multilabel_precision,
)

CEILINGS = ("task_blind", "best_constant", "all_types")


def ceilings(counts: np.ndarray) -> pd.DataFrame:
    """The three reference predictors.

    ``task_blind`` knows the object but not the task, ``best_constant`` gives one answer for
    everything, ``all_types`` answers all types. The first two are oracles, fitted to the labels
    that they are scored on; :func:`constant_of_others` is not. Vectors are the mean of the unit
    vectors of the labels or of the frequencies. For two samples no vector is more similar to both.
    For more samples this maximises the mean cosine, not the mean angular similarity, so the
    similarity of ``best_constant``, and of ``task_blind`` with three or more tasks, is only a lower
    bound on the optimum. Accuracy and precision are those of the set that is best in each: for
    precision, a single type.

    Args:
        counts: (objects, tasks, K) how often each type occurs.

    Returns:
        index :data:`CEILINGS`, columns the measures of :mod:`grasptypes.predictors.metrics`.
    """
    everything = counts.reshape(1, -1, counts.shape[-1])
    every = np.ones(counts.shape[-1], dtype=bool)
    rows = {
        "task_blind": _best(counts),
        "best_constant": _best(everything),
        "all_types": _scores(counts, every, every, every, every),
    }
    return pd.DataFrame.from_dict(rows, orient="index", columns=list(METRICS))


def constant_of_others(samples: pd.DataFrame, joint: bool) -> pd.DataFrame:
    """Scores on each object of the constant answer that is best for the other objects.

    The answer is chosen like ``best_constant`` in :func:`ceilings`, on the labels that a predictor
    is trained on when the object and its variants are left out. Its accuracy is weak: if two sets
    are nearly equally good for all objects, leaving out an object that favours the first lets the
    second win.

    Args:
        samples: of :mod:`grasptypes.labels.samples`.
        joint: see :func:`counts_asked`.

    Returns:
        index object (no variants), columns the measures, averaged over the tasks.
    """
    counts = counts_asked(samples, joint)
    rows = {}
    for member in members_by_object(sorted(set(samples["object"])), seeds=1):
        others = counts[member.train].reshape(1, -1, counts.shape[-1])
        rows[member.group] = _scores(counts[member.test], *_answers(others))
    return pd.DataFrame.from_dict(rows, orient="index", columns=list(METRICS))


def counts_asked(samples: pd.DataFrame, joint: bool) -> np.ndarray:
    """The counts behind the labels that a model has to predict, objects in alphabetical order.

    Args:
        samples: of :mod:`grasptypes.labels.samples`.
        joint: whether to predict the types of all tasks together.

    Returns:
        (objects, tasks, 6); with ``joint`` (objects, 1, 6).
    """
    shape = labels_of(samples).shape
    counts = samples.sort_values(["object", "task"])[list(COUNTS)].to_numpy().reshape(shape)
    return np.asarray(counts.sum(axis=1, keepdims=True)) if joint else counts


def _best(groups: np.ndarray) -> tuple[float, ...]:
    """Scores of the best answers to groups (G, N, K) on the same groups."""
    return _scores(groups, *_answers(groups))


def _answers(groups: np.ndarray) -> tuple[np.ndarray, ...]:
    """The best answer to each group of samples in each measure, see :func:`ceilings`.

    Args:
        groups: (G, N, K) counts.

    Returns:
        in the order of :data:`METRICS`, (G, 1, K) each: a vector, a set as truth values for
        accuracy and one for precision, and a vector for the frequencies.
    """
    labels = groups > 0
    candidates = np.array(list(product([False, True], repeat=groups.shape[-1]))[1:])
    accurate, precise = (
        candidates[measure(candidates[:, None, None], labels).mean(axis=-1).argmax(axis=0)]
        for measure in (multilabel_accuracy, multilabel_precision)
    )
    return _middle(labels), accurate[:, None], precise[:, None], _middle(groups)


def _middle(groups: np.ndarray) -> np.ndarray:
    """The mean (G, 1, K) of the unit vectors of (G, N, K)."""
    units = groups / np.linalg.norm(groups, axis=-1, keepdims=True)
    return np.asarray(units.mean(axis=1, keepdims=True))


def _scores(
    counts: np.ndarray,
    vector: np.ndarray,
    accurate: np.ndarray,
    precise: np.ndarray,
    frequent: np.ndarray,
) -> tuple[float, ...]:
    labels = counts > 0
    return (
        float(angular_similarity(vector, labels).mean()),
        float(multilabel_accuracy(accurate, labels).mean()),
        float(multilabel_precision(precise, labels).mean()),
        float(angular_similarity(frequent, counts).mean()),
    )
