"""Parts of an object, each with a role, from the roles that its points may have."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from grasptypes.segmentation.descriptors import Cloud, describe_points
from grasptypes.segmentation.network import RoleModel, trained_network
from grasptypes.settings.roles import PartRole
from grasptypes.settings.segmentation import PartSettings

Array = NDArray[np.float64]

# Points described at a time.
BLOCK = 512
# Where the roles come from, in words.
SHAPE = "its shape"


@dataclass(frozen=True)
class Parts:
    """The parts of an object, at points on its surface.

    Attributes:
        part_index: (N,) part of each point.
        roles: role of each part by name, in the order of `part_index`; None if nobody knows it.
        confidence: probability that the role of each part is right, by name; 1 if somebody said so.
        basis: where the roles come from, in words.
    """

    part_index: NDArray[np.int16]
    roles: Mapping[str, PartRole | None]
    confidence: Mapping[str, float]
    basis: str

    def summary(self) -> dict[str, Any]:
        """Plain values for JSON: the basis, and the role, confidence and share of the surface of
        each part."""
        shares = np.bincount(self.part_index, minlength=len(self.roles)) / len(self.part_index)
        return {
            "basis": self.basis,
            "parts": [
                {
                    "part": name,
                    "role": part and part.role,
                    "attributes": list(part.all_attributes) if part else [],
                    "confidence": round(self.confidence[name], 3),
                    "area_share": round(float(share), 4),
                }
                for (name, part), share in zip(self.roles.items(), shares, strict=True)
            ],
        }


def described(parts: Parts) -> str:
    """The parts and how sure their roles are, in a line."""
    return ", ".join(
        f"{name} {parts.confidence[name]:.2f}" if part else f"{name} (no role)"
        for name, part in parts.roles.items()
    )


def find_parts(
    points_m: Array,
    normals: Array,
    settings: PartSettings,
    network: RoleModel | None = None,
) -> Parts:
    """Parts of an object from its shape.

    Args:
        points_m, normals: (N, 3) points spread evenly over the surface, in any order and frame.
        network: default: the one that comes with the package.
    """
    network = network or trained_network()
    pointwise = network.probabilities(describe_surface(points_m, normals, settings))
    return likely_parts(points_m, normals, pointwise, network.roles, settings)


def likely_parts(
    points_m: Array, normals: Array, pointwise: Array, names: Sequence[str], settings: PartSettings
) -> Parts:
    """Parts of an object whose points (N, 3) have probabilities (N, R) of the named roles."""
    weights = _neighbours(points_m, normals, settings.neighbours)
    probability = smoothed(pointwise, weights, settings)
    index = _components(probability.argmax(axis=1), points_m, weights, settings.smallest_share)
    roles: dict[str, PartRole | None] = {}
    confidence, order = {}, np.zeros(index.max() + 1, dtype=np.int16)
    # The largest parts first, so that the handle proper is `handle` and a piece of it `handle_2`.
    sizes = np.bincount(index)
    for place, part in enumerate(np.argsort(-sizes, kind="stable")):
        mean = probability[index == part].mean(axis=0)
        role = names[int(mean.argmax())]
        taken = sum(known is not None and known.role == role for known in roles.values())
        name = f"{role}_{taken + 1}" if taken else role
        roles[name], confidence[name] = PartRole.check({"role": role}), float(mean.max())
        order[part] = place
    return Parts(order[index], roles, confidence, SHAPE)


def describe_surface(
    points_m: Array, normals: Array, settings: PartSettings
) -> NDArray[np.float32]:
    """Descriptors (N, D) of all points (N, 3) of an object."""
    cloud = Cloud.of_points(points_m, normals, settings.descriptors.points)
    blocks = np.array_split(np.arange(len(points_m)), -(-len(points_m) // BLOCK))
    return np.concatenate(
        [describe_points(cloud, points_m[at], normals[at], settings.descriptors) for at in blocks]
    )


def smoothed(probability: Array, weights: csr_array, settings: PartSettings) -> Array:
    """Probabilities (N, R) after each point has listened to its neighbours, again and again.

    Args:
        weights: (N, N) of the neighbours of each point.
    """
    total = weights.sum(axis=1)
    mixed = probability
    for _ in range(settings.smoothing_steps):
        heard = (weights @ mixed) / total[:, None]
        mixed = settings.own_share * probability + (1 - settings.own_share) * heard
    return np.asarray(mixed)


def _neighbours(points_m: Array, normals: Array, count: int) -> csr_array:
    """Symmetric weights (N, N) of the nearest points, lower across an edge or through a wall."""
    distance, near = cKDTree(points_m).query(points_m, count + 1)
    distance, near = distance[:, 1:], near[:, 1:]
    agreement = np.einsum("nkj,nj->nk", normals[near], normals)
    weight = np.exp(-((distance / np.median(distance)) ** 2) / 2) * np.clip(agreement, 0.05, 1)
    rows = np.repeat(np.arange(len(points_m)), count)
    directed = csr_array((weight.ravel(), (rows, near.ravel())), shape=(len(points_m),) * 2)
    return csr_array(directed + directed.T)


def _components(
    role: NDArray[np.intp], points_m: Array, neighbours: csr_array, smallest_share: float
) -> NDArray[np.intp]:
    """Part (N,) of each point: neighbours with the same role; crumbs join the part beside them."""
    weights = neighbours.tocoo()
    same = role[weights.row] == role[weights.col]
    graph = csr_array(
        (weights.data[same], (weights.row[same], weights.col[same])), shape=weights.shape
    )
    index = np.asarray(connected_components(graph, directed=False)[1], dtype=np.intp)
    while True:
        index = pd.factorize(index)[0]  # parts are numbered by their first points
        sizes = np.bincount(index)
        smallest = int(sizes.argmin())
        if len(sizes) == 1 or sizes[smallest] >= smallest_share * len(points_m):
            return np.asarray(index)
        touching = (index[weights.row] == smallest) & (index[weights.col] != smallest)
        beside = np.bincount(index[weights.col[touching]], weights.data[touching])
        if not beside.any():  # a crumb apart from everything joins the nearest part
            apart = index != smallest
            nearest = cKDTree(points_m[apart]).query(points_m[~apart])[1]
            beside = np.bincount(index[apart][nearest])
        index[index == smallest] = int(beside.argmax())
