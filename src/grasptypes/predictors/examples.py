"""Training examples of a predictor: one per image, or per image and task."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS, TYPES
from grasptypes.predictors.metrics import shares
from grasptypes.predictors.variants import TASK_LAYER, Variant
from grasptypes.settings.predictors import NO_TASK


@dataclass(frozen=True)
class Examples:
    """Aligned arrays, one row per example.

    Attributes:
        index: columns object, view, task (empty for joint labels) and fold.
        inputs: (N, F) float32 features, or (N, H, W, 3) uint8 images.
        task_vectors: (N, T) float32 one-hot, or None for a predictor without a task vector.
        labels: (N, types) float32 of 0 and 1.
        probabilities: (N, types) float32, sum 1: what the softmax is trained on.
        frequencies: (N, types) float32, sum 1: how often each type occurs.
        task_layer: the layer of the head at which the task vectors enter.
    """

    index: pd.DataFrame
    inputs: np.ndarray
    task_vectors: np.ndarray | None
    labels: np.ndarray
    probabilities: np.ndarray
    frequencies: np.ndarray
    task_layer: int = TASK_LAYER


def assemble(
    variant: Variant,
    inputs: Mapping[str, Mapping[str, np.ndarray]],
    samples: pd.DataFrame,
    folds: pd.DataFrame,
    tasks: Sequence[str],
) -> Examples:
    """The examples of one variant.

    Args:
        variant: input and output of the predictor.
        inputs: object to encoding to one input per view, (V, ...).
        samples: table of :mod:`grasptypes.labels.samples`.
        folds: table of :mod:`grasptypes.predictors.folds`.
        tasks: in the order of the task vector.

    Raises:
        InputError: an object or task has no label, or images and folds do not match.
    """
    count_of = samples.set_index(["object", "task"])[list(COUNTS)]
    asked = [""] if variant.joint_labels else list(tasks)
    rows, parts, counts = [], [], []
    for name, group in folds.groupby("object", sort=True):
        for task in asked:
            encoding = task if variant.picture_shows_task else NO_TASK
            part = _inputs(inputs, str(name), encoding, len(group))
            count = _count(count_of, str(name), [task] if task else list(tasks))
            rows.append(group.sort_values("view").assign(task=task))
            parts.append(part)
            counts.append(np.tile(count, (len(group), 1)))
    index = pd.concat(rows, ignore_index=True)[["object", "view", "task", "fold"]]
    numbers = np.concatenate(counts)
    label, frequencies = np.asarray(numbers > 0, dtype=np.float32), shares(numbers)
    vectors = np.asarray(index["task"].to_numpy()[:, None] == np.array(tasks), dtype=np.float32)
    return Examples(
        index=index,
        inputs=np.concatenate(parts),
        task_vectors=vectors if variant.task_vector else None,
        labels=label,
        probabilities=frequencies if variant.frequencies else shares(label),
        frequencies=frequencies,
        task_layer=variant.task_layer,
    )


def _inputs(
    inputs: Mapping[str, Mapping[str, np.ndarray]], name: str, encoding: str, views: int
) -> np.ndarray:
    if name not in inputs:
        raise InputError("data/features", name, "is missing, though it has folds")
    if encoding not in inputs[name]:
        raise InputError(f"data/features/{name}.npz", encoding, "this encoding is missing")
    part = inputs[name][encoding]
    if len(part) != views:
        raise InputError(
            f"data/features/{name}.npz", encoding, f"{len(part)} images, but folds of {views}"
        )
    return part


def _count(count_of: pd.DataFrame, name: str, tasks: Sequence[str]) -> np.ndarray:
    """(types,) float32: numbers of grasps, of the tasks together."""
    missing = [task for task in tasks if (name, task) not in count_of.index]
    if missing:
        raise InputError("samples", f"{name}, {missing[0]}", "has no label")
    rows = [count_of.loc[(name, task)].to_numpy(dtype=np.float32) for task in tasks]
    return np.asarray(np.sum(rows, axis=0).reshape(len(TYPES)))
