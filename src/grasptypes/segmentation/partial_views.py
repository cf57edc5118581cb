"""What a depth camera sees of an object: the points of its surface that are visible from a side."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import trimesh
from numpy.typing import NDArray

from grasptypes.segmentation.samples import sample_evenly

Array = NDArray[np.float64]

# Towards the corners of a tetrahedron: every side of an object is seen by one of these cameras.
SIDES = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3)
# Points sampled for each that is wanted, since most of them face away or are hidden.
SPARE = 4
# Lines of sight start this far above the surface, so that they do not hit it where they start.
CLEAR_M = 1e-4


def partial_views(mesh: trimesh.Trimesh, count: int, name: str) -> Iterator[tuple[Array, Array]]:
    """Points (n, 3) and normals (n, 3) that are visible from each of `SIDES`, n at most `count`.

    Args:
        name: of the object, for the random numbers.
    """
    points_m, face = sample_evenly(mesh, SPARE * count, name)
    normals = mesh.face_normals[face]
    for side in SIDES:
        seen = visible(mesh, points_m, normals, side)[:count]
        yield points_m[seen], normals[seen]


def visible(
    mesh: trimesh.Trimesh, points_m: Array, normals: Array, side: Array
) -> NDArray[np.intp]:
    """Indices of the points (N, 3) on a mesh that are visible from far away on a side (3,)."""
    facing = np.flatnonzero(normals @ side > 0)
    starts_m = points_m[facing] + CLEAR_M * normals[facing]
    hidden = mesh.ray.intersects_any(starts_m, np.broadcast_to(side, starts_m.shape))
    return np.asarray(facing[~np.asarray(hidden, dtype=bool)])
