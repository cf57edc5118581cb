"""The objects that a predictor has learned from, and how well an image and a size suit each.

A linear head cannot remember single objects. What is recognised is answered from memory, and the
more the less it could be something else: a mixture of experts (Jacobs et al. 1991).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import log_softmax, softmax

from grasptypes.predictors.general_inputs import Inputs, Targets, means, spread_of
from grasptypes.settings.general import MemorySettings

# Coordinates of tasks are about 1, in single precision.
SAME_TASK = 1e-4


@dataclass(frozen=True)
class Memory:
    """What is known of each object.

    Attributes:
        objects: (C,) names.
        looks: (C, L) mean direction of each object's images in the last features; unit vectors.
        facts: (C, 4) of `general_inputs.FACTS`.
        tasks: (T, K) coordinates of the tasks learned from.
        occurs: (T, C, types) which types each object has for a task; NaN where nobody knows.
        shares: (T, C, types) how often.
    """

    settings: MemorySettings
    objects: np.ndarray
    looks: np.ndarray
    facts: np.ndarray
    tasks: np.ndarray
    occurs: np.ndarray
    shares: np.ndarray

    @classmethod
    def of(cls, inputs: Inputs, targets: Targets, settings: MemorySettings) -> Memory:
        """Remember the objects of some examples."""
        names, index = np.unique(targets.objects, return_inverse=True)
        tasks, task = np.unique(inputs.tasks, axis=0, return_inverse=True)
        known = np.full((2, len(tasks), len(names), targets.occurs.shape[1]), np.nan)
        known[0, task.ravel(), index] = targets.occurs
        known[1, task.ravel(), index] = targets.shares
        looks = _units(means(_units(inputs.features[:, -settings.last_features :]), index))
        return cls(settings, names, looks, means(inputs.facts, index), tasks, *known)

    def likeness(self, features: np.ndarray) -> np.ndarray:
        """How much images look like each object: cosines (N, C).

        Args:
            features: (N, F) of the backbone.
        """
        return np.asarray(_units(features[:, -self.looks.shape[1] :]) @ self.looks.T)

    def chances(
        self, features: np.ndarray, facts: np.ndarray, images: np.ndarray | float = 1
    ) -> np.ndarray:
        """How likely each known object is shown, and in the last column something else (N, C + 1).

        The image tells which of the known objects it may be; the size tells besides how
        likely it is any of them. Several images tell more than one, but not as much as if nothing
        that they share could mislead.

        Args:
            features: (N, F) of the backbone.
            facts: (N, 4); NaN where unknown.
            images: (N,) of how many images the features are the mean.
        """
        settings = self.settings
        weight = np.reshape(images, (-1, 1)) ** settings.images_power
        alike = log_softmax(self.likeness(features) * weight / settings.temperature, axis=1)
        middle, spread = self.facts.mean(axis=0), self.facts.std(axis=0)
        own = spread_of(settings.size_spread, settings.mass_spread)
        known = alike + _log_density(facts[:, None] - self.facts, own)
        other = _log_density(facts - middle, spread)
        prior = np.log([settings.known, 1 - settings.known])
        return np.asarray(softmax(np.column_stack([known + prior[0], other + prior[1]]), axis=1))

    def mixed(
        self, occurs: np.ndarray, shares: np.ndarray, inputs: Inputs
    ) -> tuple[np.ndarray, np.ndarray]:
        """Answers (N, types) mixed with those from memory, for tasks that were learned."""
        chances = self.chances(inputs.features, inputs.facts, inputs.images)
        found = occurs.copy(), shares.copy()
        for number, task in enumerate(self.tasks):
            rows = (np.abs(inputs.tasks - task) < SAME_TASK).all(axis=1)
            known = np.isfinite(self.occurs[number, :, 0])
            weights = chances[rows][:, [*known, True]]
            weights /= weights.sum(axis=1, keepdims=True)
            for mix, memory in zip(found, (self.occurs, self.shares), strict=True):
                mix[rows] = weights[:, :-1] @ memory[number, known] + weights[:, -1:] * mix[rows]
        return found[0], found[1]


def _units(rows: np.ndarray) -> np.ndarray:
    """Rows (N, D) with length 1."""
    return np.asarray(rows / np.linalg.norm(rows, axis=1, keepdims=True))


def _log_density(off: np.ndarray, spread: np.ndarray) -> np.ndarray:
    """Of normal distributions (..., 4), summed over what is known, but for a constant."""
    terms = (off / spread) ** 2 / 2 + np.log(spread)
    return np.asarray(-np.nansum(terms, axis=-1))
