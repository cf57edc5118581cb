"""Signed distance to an object on a regular grid, for fast batched lookups."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import igl
import numpy as np
from numpy.typing import ArrayLike, NDArray

from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_npz

Array = NDArray[np.float64]


@dataclass(frozen=True)
class DistanceGrid:
    """Signed distances in the object frame, negative inside.

    Attributes:
        values: (nx, ny, nz) float32 distances in metres at the nodes.
        origin_m: (3,) position of node (0, 0, 0).
        spacing_m: distance between neighbouring nodes.
    """

    values: NDArray[np.float32]
    origin_m: Array
    spacing_m: float

    @classmethod
    def from_mesh(
        cls, vertices: ArrayLike, faces: ArrayLike, spacing_m: float, margin_m: float
    ) -> DistanceGrid:
        """Sample the distance to a mesh (V, 3), (F, 3) up to a margin around its bounds.

        The sign comes from the nearest face for a closed mesh, and from the winding number
        otherwise, so that small holes in a scan do no harm.
        """
        points_m = np.ascontiguousarray(vertices, dtype=np.float64)
        triangles = np.ascontiguousarray(faces, dtype=np.int64)
        origin_m = points_m.min(axis=0) - margin_m
        shape = grid_shape(origin_m, points_m.max(axis=0) + margin_m, spacing_m)
        nodes = np.indices(shape).reshape(3, -1).T * spacing_m + origin_m
        distances = signed_distance(nodes, points_m, triangles)
        return cls(distances.reshape(shape).astype(np.float32), origin_m, float(spacing_m))

    @classmethod
    def load(cls, path: str | Path) -> DistanceGrid:
        """Read a grid; raises InputError if the file is not a grid."""
        arrays = read_npz(path)
        missing = {"values", "origin_m", "spacing_m"} - set(arrays)
        if missing:
            raise InputError(path, ", ".join(sorted(missing)), "missing from the distance grid")
        return cls(arrays["values"], arrays["origin_m"], float(arrays["spacing_m"]))

    def save(self, path: str | Path) -> None:
        """Write the grid as npz with the attributes' names as keys."""
        write_npz(
            path,
            {
                "values": self.values,
                "origin_m": self.origin_m,
                "spacing_m": np.float64(self.spacing_m),
            },
        )

    def distance(self, points_m: ArrayLike) -> Array:
        """Return trilinear signed distances (...) in metres at points (..., 3).

        Outside the grid: the value at the nearest point of its box, plus the distance to that.
        """
        return self.distance_and_gradient(points_m)[0]

    def distance_and_gradient(self, points_m: ArrayLike) -> tuple[Array, Array]:
        """Return distances (...) and their gradients (..., 3) with respect to the points.

        The gradient is that of the interpolant, so its length is only approximately 1; it points
        away from the object. Outside the grid it points away from the box.
        """
        points = np.asarray(points_m, dtype=np.float64)
        last = np.array(self.values.shape) - 1
        position = (points - self.origin_m) / self.spacing_m
        clamped = np.clip(position, 0, last)
        cell = np.minimum(clamped.astype(np.int64), last - 1)
        fraction = clamped - cell
        corners = self._corners(cell)
        value, gradient = _interpolate(corners, fraction)
        away = (position - clamped) * self.spacing_m
        outside_m = np.linalg.norm(away, axis=-1)
        outside = outside_m > 0
        gradient = gradient / self.spacing_m
        gradient[outside] = away[outside] / outside_m[outside, None]
        return value + outside_m, gradient

    def _corners(self, cell: NDArray[np.int64]) -> Array:
        """Return the values (..., 2, 2, 2) at the corners of cells (..., 3)."""
        strides = np.array([self.values.shape[1] * self.values.shape[2], self.values.shape[2], 1])
        steps = np.indices((2, 2, 2)).reshape(3, -1).T @ strides
        flat = self.values.reshape(-1)[(cell @ strides)[..., None] + steps]
        return np.asarray(flat.reshape(*cell.shape[:-1], 2, 2, 2), dtype=np.float64)


def grid_shape(low_m: Array, high_m: Array, spacing_m: float) -> tuple[int, ...]:
    """Number of nodes along each axis of a grid from one corner (3,) of a box to the other."""
    return tuple((np.ceil((high_m - low_m) / spacing_m).astype(int) + 1).tolist())


def signed_distance(points_m: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> Array:
    """Exact distances (n,) of points (n, 3) to a mesh (V, 3), (F, 3), metres, negative inside.

    The sign comes from the nearest face for a closed mesh. Otherwise, for example for a scan with
    holes, a point is inside where the winding number w exceeds 1/2 (libigl's own combination
    multiplies the distance by 1 - 2w, which is not a distance unless w is 0 or 1).
    """
    points = np.ascontiguousarray(points_m, dtype=np.float64)
    corners = np.ascontiguousarray(vertices, dtype=np.float64)
    triangles = np.ascontiguousarray(faces, dtype=np.int64)
    if igl.is_edge_manifold(triangles) and len(igl.boundary_facets(triangles)[0]) == 0:
        kind = igl.SIGNED_DISTANCE_TYPE_PSEUDONORMAL
        return np.asarray(igl.signed_distance(points, corners, triangles, kind)[0])
    apart = igl.signed_distance(points, corners, triangles, igl.SIGNED_DISTANCE_TYPE_UNSIGNED)[0]
    inside = np.abs(igl.fast_winding_number(corners, triangles, points)) > 0.5
    return np.asarray(np.where(inside, -apart, apart))


def _interpolate(corners: Array, fraction: Array) -> tuple[Array, Array]:
    """Interpolate (..., 2, 2, 2) corners; returns values (...) and gradients (..., 3) per cell."""
    x, y, z = (fraction[..., axis] for axis in range(3))
    along_x = corners[..., 1, :, :] - corners[..., 0, :, :]
    plane = corners[..., 0, :, :] + x[..., None, None] * along_x
    along_y = plane[..., 1, :] - plane[..., 0, :]
    line = plane[..., 0, :] + y[..., None] * along_y
    along_z = line[..., 1] - line[..., 0]
    slope_x = along_x[..., 0, :] + y[..., None] * (along_x[..., 1, :] - along_x[..., 0, :])
    gradient = np.stack(
        [
            slope_x[..., 0] + z * (slope_x[..., 1] - slope_x[..., 0]),
            along_y[..., 0] + z * (along_y[..., 1] - along_y[..., 0]),
            along_z,
        ],
        axis=-1,
    )
    return line[..., 0] + z * along_z, gradient
