"""What the predictor for unseen objects is told: images, size, mass and task, each in numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import get_args

import numpy as np

from grasptypes.settings.roles import read_roles
from grasptypes.settings.tasks import Grip, Task

GRIPS = get_args(Grip)
SIZE = ("log_longest", "log_middle", "log_shortest")
MASS = "log_mass"
FACTS = (*SIZE, MASS)


@dataclass(frozen=True)
class Pictures:
    """Images of any number of objects, as the backbone sees them.

    Attributes:
        objects: (N,) name of the object in each image.
        features: (N, F) of the backbone.
        classes: (N, 1000) log-probabilities of ImageNet's classes.
    """

    objects: np.ndarray
    features: np.ndarray
    classes: np.ndarray

    def of(self, names: Iterable[str]) -> Pictures:
        """The images of some objects."""
        return self.rows(np.isin(self.objects, list(names)))

    def rows(self, chosen: np.ndarray) -> Pictures:
        """Some of the images, by places or truth values."""
        return Pictures(self.objects[chosen], self.features[chosen], self.classes[chosen])


def joined(parts: Sequence[Pictures]) -> Pictures:
    """The images of several groups of objects."""
    return Pictures(
        np.concatenate([part.objects for part in parts]),
        np.concatenate([part.features for part in parts]),
        np.concatenate([part.classes for part in parts]),
    )


def spread_of(size: float, mass: float) -> np.ndarray:
    """Standard deviations (4,) of :data:`FACTS`, of each extent and of the mass."""
    return np.array([size] * len(SIZE) + [mass])


def task_vector(task: Task) -> np.ndarray:
    """What a task demands of roles and hands: (D,), each number between about 0 and 1.

    How likely people touch each role, which roles stay free, the factor on hazards, where along a
    handle they hold it, and the factors on grips.
    """
    roles = list(read_roles().roles)
    return np.array(
        [task.touched.get(role, 0.0) for role in roles]
        + [float(role in task.free) for role in roles]
        + [task.hazard, *task.position]
        + [task.grips.get(grip, 1.0) for grip in GRIPS],
        dtype=np.float64,
    )


@dataclass(frozen=True)
class TaskCode:
    """Coordinates of tasks in the directions in which those learned from differ.

    A new task is described by how far it lies in these directions, so a model with these inputs
    answers for tasks that it has not learned.

    Attributes:
        middle: (D,) mean of the vectors of the tasks learned from.
        directions: (D, K), scaled so that coordinates have variance 1 over these tasks.
    """

    middle: np.ndarray
    directions: np.ndarray

    @classmethod
    def of(cls, tasks: Mapping[str, Task]) -> TaskCode:
        """The code in which these tasks differ; K is at most their number less one."""
        vectors = np.stack([task_vector(task) for task in tasks.values()])
        middle = vectors.mean(axis=0)
        _, lengths, axes = np.linalg.svd(vectors - middle, full_matrices=False)
        kept = lengths > 1e-6
        return cls(middle, axes[kept].T / lengths[kept] * np.sqrt(len(vectors)))

    def __call__(self, task: Task) -> np.ndarray:
        """Coordinates (K,) of a task."""
        return np.asarray((task_vector(task) - self.middle) @ self.directions)


@dataclass(frozen=True)
class Inputs:
    """Rows to learn from or to answer, one per image, or several images of one object, and task.

    Attributes:
        features: (N, F) of the backbone.
        classes: (N, C) log-probabilities of ImageNet's classes.
        facts: (N, 4) of `general_inputs.FACTS`; NaN where unknown.
        tasks: (N, K) coordinates of the task.
        images: (N,) of how many images the features and classes are the mean.
    """

    features: np.ndarray
    classes: np.ndarray
    facts: np.ndarray
    tasks: np.ndarray
    images: np.ndarray

    def __len__(self) -> int:
        return len(self.features)

    def together(self, objects: np.ndarray) -> Inputs:
        """One row per object, in the order of their names.

        Args:
            objects: (N,) of the rows, all for one task.
        """
        _, first, index = np.unique(objects, return_index=True, return_inverse=True)
        return replace(
            self.rows(first),
            features=means(self.features, index),
            classes=means(self.classes, index),
            images=np.bincount(index, self.images),
        )

    def rows(self, chosen: np.ndarray) -> Inputs:
        """Some of the rows."""
        return Inputs(*(array[chosen] for array in vars(self).values()))

    def without(self, names: Sequence[str]) -> Inputs:
        """The same rows, with some facts unknown."""
        facts = self.facts.copy()
        facts[:, [FACTS.index(name) for name in names]] = np.nan
        return replace(self, facts=facts)


def means(rows: np.ndarray, index: np.ndarray) -> np.ndarray:
    """Mean of the rows (N, D) with each index from 0 to the largest."""
    totals = np.zeros((index.max() + 1, rows.shape[1]))
    np.add.at(totals, index, rows)
    return np.asarray(totals / np.bincount(index)[:, None])


@dataclass(frozen=True)
class Targets:
    """What is learned, one row per row of the inputs.

    Attributes:
        occurs: (N, types) 0 and 1.
        shares: (N, types) frequencies, sum 1.
        weights: (N,) of the rows.
        objects: (N,) names.
    """

    occurs: np.ndarray
    shares: np.ndarray
    weights: np.ndarray
    objects: np.ndarray


@dataclass(frozen=True)
class Projection:
    """Leading principal directions of an array's columns, with equal variances."""

    middle: np.ndarray
    directions: np.ndarray

    @classmethod
    def of(cls, rows: np.ndarray, count: int, whitening: float) -> Projection:
        """The `count` leading directions, whose variance to the power of `whitening` is removed."""
        count = min(count, len(rows) - 1, rows.shape[1])
        if count == 0:
            return cls(rows.mean(axis=0), np.zeros((rows.shape[1], 0)))
        from sklearn.decomposition import PCA  # answering needs no scikit-learn

        found = PCA(count, svd_solver="randomized", random_state=0).fit(rows)
        lengths = np.maximum(np.sqrt(found.explained_variance_), 1e-6)
        scale = lengths**whitening * lengths[0] ** (1 - whitening)
        return cls(found.mean_, found.components_.T / scale)

    def __call__(self, rows: np.ndarray) -> np.ndarray:
        return np.asarray((rows - self.middle) @ self.directions)
