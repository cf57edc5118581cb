"""Compiled signed distances at single points, the basis of all batched searches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.objects.distance_grid import DistanceGrid

Array = NDArray[np.float64]


class Field(NamedTuple):
    """A signed distance grid as plain arrays, for compiled functions."""

    values: NDArray[np.float32]
    """(nx, ny, nz) metres, negative inside."""
    origin: Array
    """(3,) position of the first node, metres."""
    spacing: float
    """Metres between nodes."""


class Fields(NamedTuple):
    """Several grids of different sizes in one array, selected by an index."""

    values: NDArray[np.float32]
    """(n,) all nodes, one grid after the other."""
    starts: NDArray[np.int64]
    """(k,) where each grid begins in `values`."""
    shapes: NDArray[np.int64]
    """(k, 3) nodes along each axis."""
    origins: Array
    """(k, 3) metres."""
    spacing: float
    """Metres between nodes, the same for all."""


def field(grid: DistanceGrid) -> Field:
    """The grid's arrays in the types that the compiled functions expect."""
    values = np.ascontiguousarray(grid.values, dtype=np.float32)
    return Field(values, np.asarray(grid.origin_m, dtype=np.float64), float(grid.spacing_m))


def fields(grids: Sequence[DistanceGrid]) -> Fields:
    """Pack grids of equal spacing."""
    packed = [field(grid) for grid in grids]
    sizes = [grid.values.size for grid in packed]
    return Fields(
        np.concatenate([grid.values.ravel() for grid in packed]),
        np.cumsum([0, *sizes[:-1]]),
        np.array([grid.values.shape for grid in packed]),
        np.array([grid.origin for grid in packed]),
        packed[0].spacing,
    )


@compiled(inline=True)
def _cell(coordinate: float, nodes: int) -> tuple[int, float, float]:
    """Lower node, weight of the upper one, and distance (in nodes) outside the grid."""
    inside = min(max(coordinate, 0.0), nodes - 1.0)
    lower = min(int(inside), nodes - 2)
    return lower, inside - lower, coordinate - inside


@compiled(inline=True)
def _beyond(value: float, way_squared: float) -> float:
    """Lower bound on the distance at a point outside a box.

    The path to the nearest point of the convex box and the path from there to the surface never
    form an acute angle, hence Pythagoras.
    """
    if way_squared == 0.0:
        return value
    return float(np.sqrt(value * value + way_squared))


@compiled()
def distance(grid: Field, x: float, y: float, z: float) -> float:
    """Signed distance at a point in metres, trilinear.

    Outside the grid it is a lower bound, so that a step of this length never jumps over the
    surface.
    """
    values, origin, h = grid
    i, u, a = _cell((x - origin[0]) / h, values.shape[0])
    j, v, b = _cell((y - origin[1]) / h, values.shape[1])
    k, w, c = _cell((z - origin[2]) / h, values.shape[2])
    low = (1 - v) * ((1 - w) * values[i, j, k] + w * values[i, j, k + 1]) + v * (
        (1 - w) * values[i, j + 1, k] + w * values[i, j + 1, k + 1]
    )
    i += 1
    high = (1 - v) * ((1 - w) * values[i, j, k] + w * values[i, j, k + 1]) + v * (
        (1 - w) * values[i, j + 1, k] + w * values[i, j + 1, k + 1]
    )
    return _beyond((1 - u) * low + u * high, h * h * (a * a + b * b + c * c))


@compiled()
def distances(grid: Field, points: Array) -> Array:
    """Signed distances (n,) at points (n, 3), metres."""
    result = np.empty(len(points))
    for n in range(len(points)):
        result[n] = distance(grid, points[n, 0], points[n, 1], points[n, 2])
    return result


@compiled()
def gradient(grid: Field, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Unit vector away from the surface at a point, by central differences over one node."""
    h = 0.5 * grid.spacing
    gx = distance(grid, x + h, y, z) - distance(grid, x - h, y, z)
    gy = distance(grid, x, y + h, z) - distance(grid, x, y - h, z)
    gz = distance(grid, x, y, z + h) - distance(grid, x, y, z - h)
    norm = max(np.sqrt(gx * gx + gy * gy + gz * gz), 1e-12)
    return gx / norm, gy / norm, gz / norm


@compiled()
def distance_in(grids: Fields, index: int, x: float, y: float, z: float) -> float:
    """Like `distance`, in one of several grids."""
    values, starts, shapes, origins, h = grids
    ny, nz = shapes[index, 1], shapes[index, 2]
    i, u, a = _cell((x - origins[index, 0]) / h, shapes[index, 0])
    j, v, b = _cell((y - origins[index, 1]) / h, ny)
    k, w, c = _cell((z - origins[index, 2]) / h, nz)
    n = starts[index] + (i * ny + j) * nz + k
    low = (1 - v) * ((1 - w) * values[n] + w * values[n + 1]) + v * (
        (1 - w) * values[n + nz] + w * values[n + nz + 1]
    )
    n += ny * nz
    high = (1 - v) * ((1 - w) * values[n] + w * values[n + 1]) + v * (
        (1 - w) * values[n + nz] + w * values[n + nz + 1]
    )
    return _beyond((1 - u) * low + u * high, h * h * (a * a + b * b + c * c))
