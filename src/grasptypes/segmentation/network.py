"""The network that says what points of a surface are for, run with NumPy alone."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.special import softmax

from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_npz
from grasptypes.segmentation import NETWORK


class RoleModel(Protocol):
    """What gives each point of an object probabilities of roles."""

    @property
    def roles(self) -> tuple[str, ...]:
        """Names (R,) of the roles."""

    def probabilities(self, descriptors: NDArray[np.float32]) -> NDArray[np.float64]:
        """Probabilities (N, R) of the roles of the points of an object, with descriptors (N, D)."""


@dataclass(frozen=True)
class RoleNetwork:
    """Layers that see each point, then the point beside mean and maximum over the whole object.

    Attributes:
        roles: (R,) names of the outputs.
        pooled: points of an object over which to pool, as many as in training.
        centre, scale: (D,) of the descriptors.
        weights, biases: of the four layers, (inputs, outputs) and (outputs,); two before the
            pooling, two after it.
    """

    roles: tuple[str, ...]
    pooled: int
    centre: NDArray[np.float32]
    scale: NDArray[np.float32]
    weights: tuple[NDArray[np.float32], ...]
    biases: tuple[NDArray[np.float32], ...]

    # Standard deviations beyond which a descriptor counts as this far from its mean.
    LIMIT: ClassVar[float] = 5.0

    def probabilities(self, descriptors: NDArray[np.float32]) -> NDArray[np.float64]:
        """Probabilities (N, R) of the roles of points with descriptors (N, D), all of one object.

        The points are in random order: the first ones stand for all of them.
        """
        scaled = np.clip((descriptors - self.centre) / self.scale, -self.LIMIT, self.LIMIT)
        points = self._layer(1, self._layer(0, scaled))
        some = points[: self.pooled]
        pooled = np.concatenate([some.mean(axis=0), some.max(axis=0)])
        context = np.concatenate(
            [points, np.broadcast_to(pooled, (len(points), len(pooled)))], axis=1
        )
        logits = self._layer(2, context) @ self.weights[3] + self.biases[3]
        chances: NDArray[np.float64] = softmax(logits.astype(np.float64), axis=1)
        return chances

    def _layer(self, number: int, inputs: NDArray[np.float32]) -> NDArray[np.float32]:
        return np.asarray(np.maximum(inputs @ self.weights[number] + self.biases[number], 0))

    def write(self, path: str | Path) -> None:
        """Write the network, with weights in half precision."""
        arrays = {
            "roles": np.array(self.roles, dtype=np.str_),
            "pooled": np.array(self.pooled),
            "centre": self.centre,
            "scale": self.scale,
        }
        for number, (weights, biases) in enumerate(zip(self.weights, self.biases, strict=True)):
            arrays |= {f"weights_{number}": weights.astype(np.float16), f"biases_{number}": biases}
        write_npz(path, arrays)


def read_network(path: str | Path) -> RoleNetwork:
    """The network of a file.

    Raises:
        InputError: the file is missing or damaged.
    """
    arrays = read_npz(path)
    keys = [f"{name}_{number}" for name in ("weights", "biases") for number in range(4)]
    if missing := {"roles", "pooled", "centre", "scale", *keys} - set(arrays):
        raise InputError(path, ", ".join(sorted(missing)), "missing from the network")
    layers = [arrays[key].astype(np.float32) for key in keys]
    roles = tuple(str(role) for role in arrays["roles"])
    return RoleNetwork(
        roles,
        int(arrays["pooled"]),
        arrays["centre"],
        arrays["scale"],
        tuple(layers[:4]),
        tuple(layers[4:]),
    )


@cache
def trained_network() -> RoleNetwork:
    """The network that comes with the package."""
    return read_network(NETWORK)
