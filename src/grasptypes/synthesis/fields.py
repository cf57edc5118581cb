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
    """A signed distance grid as compiled functions take it."""

    values: NDArray[np.float32]
    """(n,) metres, negative inside; the nodes of this grid and perhaps of others."""
    start: int
    """Where this grid begins in `values`."""
    shape: tuple[int, int, int]
    """Nodes along each axis."""
    origin: tuple[float, float, float]
    """Position of the first node, metres."""
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
    """The grid in the types that the compiled functions expect."""
    values = np.asarray(grid.values, dtype=np.float32).ravel()
    x, y, z = (float(number) for number in grid.origin_m)
    return Field(values, 0, grid.values.shape, (x, y, z), float(grid.spacing_m))


def fields(grids: Sequence[DistanceGrid]) -> Fields:
    """Pack grids of equal spacing."""
    packed = [field(grid) for grid in grids]
    return Fields(
        np.concatenate([grid.values for grid in packed]),
        np.cumsum([0, *(grid.values.size for grid in packed[:-1])]),
        np.array([grid.shape for grid in packed]),
        np.array([grid.origin for grid in packed]),
        packed[0].spacing,
    )


@compiled(inline=True)
def field_at(grids: Fields, index: int) -> Field:
    """One of several fields."""
    shapes, origins = grids.shapes, grids.origins
    shape = shapes[index, 0], shapes[index, 1], shapes[index, 2]
    origin = origins[index, 0], origins[index, 1], origins[index, 2]
    return Field(grids.values, grids.starts[index], shape, origin, grids.spacing)


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
    values, start, (nx, ny, nz), origin, h = grid
    i, u, a = _cell((x - origin[0]) / h, nx)
    j, v, b = _cell((y - origin[1]) / h, ny)
    k, w, c = _cell((z - origin[2]) / h, nz)
    n = start + (i * ny + j) * nz + k
    low = (1 - v) * ((1 - w) * values[n] + w * values[n + 1]) + v * (
        (1 - w) * values[n + nz] + w * values[n + nz + 1]
    )
    n += ny * nz
    high = (1 - v) * ((1 - w) * values[n] + w * values[n + 1]) + v * (
        (1 - w) * values[n + nz] + w * values[n + nz + 1]
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
def slope(grid: Field, x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """Central differences over one node along each axis, and the length of the three."""
    h = 0.5 * grid.spacing
    gx = distance(grid, x + h, y, z) - distance(grid, x - h, y, z)
    gy = distance(grid, x, y + h, z) - distance(grid, x, y - h, z)
    gz = distance(grid, x, y, z + h) - distance(grid, x, y, z - h)
    return gx, gy, gz, max(np.sqrt(gx * gx + gy * gy + gz * gz), 1e-12)


@compiled()
def gradient(grid: Field, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Unit vector away from the surface at a point, by central differences over one node."""
    gx, gy, gz, norm = slope(grid, x, y, z)
    return gx / norm, gy / norm, gz / norm
