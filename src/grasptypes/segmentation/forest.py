"""A random forest that names the roles of points one by one: what a simpler method finds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from sklearn.ensemble import RandomForestClassifier

from grasptypes.seeds import seed
from grasptypes.segmentation.samples import RoleSamples, family_weights
from grasptypes.settings.roles import read_roles
from grasptypes.settings.segmentation import ForestSettings


@dataclass(frozen=True)
class RoleForest:
    """Trees that see one point each, without the rest of the object.

    Attributes:
        roles: (R,) names of the outputs.
        trees: their classes are places in `roles`.
    """

    roles: tuple[str, ...]
    trees: RandomForestClassifier

    def probabilities(self, descriptors: NDArray[np.float32]) -> NDArray[np.float64]:
        """Probabilities (N, R) of the roles of points with descriptors (N, D)."""
        chances = np.zeros((len(descriptors), len(self.roles)))
        chances[:, self.trees.classes_] = self.trees.predict_proba(descriptors)
        return chances


def grow_forest(
    samples: RoleSamples,
    rows: NDArray[np.intp],
    key: Sequence[str | int],
    settings: ForestSettings,
) -> RoleForest:
    """A forest grown on some of the shapes; families of many kinds count as for the network.

    Args:
        rows: (n,) shapes to learn from.
        key: name of the computation, for its random numbers.
    """
    inputs = samples.descriptors[rows, : settings.points]
    targets = samples.roles[rows, : inputs.shape[1]]
    weights = np.repeat(family_weights(samples.families[rows]), inputs.shape[1])
    trees = RandomForestClassifier(
        settings.trees,
        min_samples_leaf=settings.least_points,
        random_state=seed("role forest", *key) % 2**32,
    )
    trees.fit(inputs.reshape(-1, inputs.shape[2]), targets.ravel(), weights)
    return RoleForest(tuple(read_roles().roles), trees)
