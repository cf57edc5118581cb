"""Whether anything that was learned looks like an image at all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from grasptypes.predictors.families import Families, family_folds
from grasptypes.predictors.general_inputs import Pictures, Projection
from grasptypes.settings.general import StrangenessSettings


@dataclass(frozen=True)
class Strangeness:
    """The directions in which images of known objects differ, and how far they reach.

    Attributes:
        spread: the leading directions of all images, with equal variances.
        limit: length of a projected image beyond which it is strange.
    """

    spread: Projection
    limit: float

    @classmethod
    def of(
        cls, pictures: Pictures, families: Families, settings: StrangenessSettings, seed: int
    ) -> Strangeness:
        """Learn from images; the limit is that of objects which were held out with their families.

        Args:
            seed: of the workflow.
        """
        lengths = []
        for out in family_folds(families, settings.folds, seed):
            held = np.array([bool(families[name] & out) for name in pictures.objects])
            known = Projection.of(pictures.features[~held], settings.directions, 1.0)
            lengths.append(np.linalg.norm(known(pictures.features[held]), axis=1))
        limit = np.quantile(np.concatenate(lengths), 1 - settings.false_alarms)
        return cls(Projection.of(pictures.features, settings.directions, 1.0), float(limit))

    def __call__(self, features: np.ndarray) -> np.ndarray:
        """How unlike all known objects images (N, F) are, (N,); above 1 nothing known is like them.

        The Mahalanobis distance from the middle of all images (Lee et al. 2018).
        """
        return np.asarray(np.linalg.norm(self.spread(features), axis=1) / self.limit)
