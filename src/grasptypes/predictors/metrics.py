"""Measures between predicted and labelled grasp types: three of the paper (section IV-B), and one.

The similarity to the frequencies of types compares the softmax with how often each type occurs,
where the paper's similarity gives every type that occurs the same probability.

All functions take one row per sample and one column per grasp type, and return one value per
sample.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import softmax

METRICS = (
    "angular_similarity",
    "multilabel_accuracy",
    "multilabel_precision",
    "frequency_similarity",
)
SIGMOID_THRESHOLD = 0.5  # paper, section IV-B


def angular_similarity(predicted: ArrayLike, target: ArrayLike) -> np.ndarray:
    """1 - 2 angle / pi: 1 for the same direction, 0 for orthogonal non-negative vectors.

    Args:
        predicted: (..., K) non-negative, no row all zeros.
        target: (..., K) likewise; broadcast against ``predicted``.

    Raises:
        ValueError: a negative or non-finite entry, or a row without a direction.
    """
    first, second = _directions(predicted), _directions(target)
    # The chord is accurate at small angles, where the arc cosine loses half the digits.
    half_chord = np.linalg.norm(first - second, axis=-1) / 2
    similarity: np.ndarray = 1 - 4 / np.pi * np.arcsin(np.clip(half_chord, 0, 1))
    return similarity


def multilabel_accuracy(predicted: ArrayLike, target: ArrayLike) -> np.ndarray:
    """Intersection over union of the two sets of types; 1 if both are empty.

    Args:
        predicted: (..., K) truth values.
        target: (..., K) likewise.
    """
    both, either = _overlap(predicted, target)
    return np.where(either > 0, both / np.maximum(either, 1), 1.0)


def multilabel_precision(predicted: ArrayLike, target: ArrayLike) -> np.ndarray:
    """Share of predicted types that are correct; for no prediction 0, or 1 if there is no type.

    Args:
        predicted: (..., K) truth values.
        target: (..., K) likewise.
    """
    both, either = _overlap(predicted, target)
    count = np.asarray(predicted, dtype=bool).sum(axis=-1)
    return np.where(count > 0, both / np.maximum(count, 1), np.where(either > 0, 0.0, 1.0))


def shares(counts: np.ndarray) -> np.ndarray:
    """Counts (..., K) divided by their sum, in their floating type; no row is all zeros."""
    vectors: np.ndarray = counts / counts.sum(axis=-1, keepdims=True)
    return vectors


def chosen(logits: ArrayLike) -> np.ndarray:
    """Types (..., K) whose sigmoid exceeds 0.5, from logits (..., K)."""
    limit = np.log(SIGMOID_THRESHOLD / (1 - SIGMOID_THRESHOLD))
    types: np.ndarray = np.asarray(logits) > limit
    return types


def measures(
    logits: ArrayLike, labels: np.ndarray, frequencies: ArrayLike
) -> dict[str, np.ndarray]:
    """The measures (N,) of each sample, by their names in :data:`METRICS`.

    Args:
        logits: (N, K) outputs of a predictor.
        labels: (N, K) truth values, no row all zeros.
        frequencies: (N, K) how often each type occurs.
    """
    types, vectors = chosen(logits), softmax(logits, axis=-1)
    return {
        "angular_similarity": angular_similarity(vectors, shares(labels)),
        "multilabel_accuracy": multilabel_accuracy(types, labels),
        "multilabel_precision": multilabel_precision(types, labels),
        "frequency_similarity": angular_similarity(vectors, frequencies),
    }


def evaluate(logits: ArrayLike, labels: np.ndarray, frequencies: ArrayLike) -> dict[str, float]:
    """Means of the measures over the samples, see :func:`measures`."""
    values = measures(logits, labels, frequencies)
    return {name: float(value.mean()) for name, value in values.items()}


def _directions(vectors: ArrayLike) -> np.ndarray:
    vectors = np.asarray(vectors, dtype=float)
    if not np.isfinite(vectors).all() or (vectors < 0).any():
        raise ValueError("angular similarity needs finite, non-negative vectors")
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    if (lengths == 0).any():
        raise ValueError("angular similarity needs vectors that are not all zeros")
    directions: np.ndarray = vectors / lengths
    return directions


def _overlap(predicted: ArrayLike, target: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    predicted, target = np.asarray(predicted, dtype=bool), np.asarray(target, dtype=bool)
    return (predicted & target).sum(axis=-1), (predicted | target).sum(axis=-1)
