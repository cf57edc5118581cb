"""Links at poses: their points, their distance to an object, and their depth in each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.synthesis.fields import Field, distance, field_at
from grasptypes.synthesis.hand_model import HandModel

Array = NDArray[np.float64]


@compiled(inline=True)
def moved(pose: Array, points: Array, row: int) -> tuple[float, float, float]:
    """One of the points (n, 3), transformed by a pose (3+, 4)."""
    x, y, z = points[row, 0], points[row, 1], points[row, 2]
    return (
        pose[0, 0] * x + pose[0, 1] * y + pose[0, 2] * z + pose[0, 3],
        pose[1, 0] * x + pose[1, 1] * y + pose[1, 2] * z + pose[1, 3],
        pose[2, 0] * x + pose[2, 1] * y + pose[2, 2] * z + pose[2, 3],
    )


@compiled()
def least_gap(model: HandModel, grid: Field, link: int, pose: Array) -> float:
    """A lower bound on the distances of a link's points."""
    x, y, z = moved(pose, model.centres, link)
    return float(distance(grid, x, y, z) - model.radii[link])


@compiled()
def overlap(model: HandModel, link: int, pose: Array, other: int, other_pose: Array) -> float:
    """Depth of a link's deepest point in another link, 0 if they do not overlap."""
    cx, cy, cz = moved(pose, model.centres, link)
    ox, oy, oz = moved(other_pose, model.centres, other)
    reach = model.radii[link] + model.radii[other]
    if (cx - ox) ** 2 + (cy - oy) ** 2 + (cz - oz) ** 2 > reach * reach:
        return 0.0
    depth = 0.0
    for index in range(model.starts[link], model.starts[link + 1]):
        x, y, z = moved(pose, model.points, index)
        if (x - ox) ** 2 + (y - oy) ** 2 + (z - oz) ** 2 > model.radii[other] ** 2:
            continue
        x, y, z = x - other_pose[0, 3], y - other_pose[1, 3], z - other_pose[2, 3]
        bx = other_pose[0, 0] * x + other_pose[1, 0] * y + other_pose[2, 0] * z
        by = other_pose[0, 1] * x + other_pose[1, 1] * y + other_pose[2, 1] * z
        bz = other_pose[0, 2] * x + other_pose[1, 2] * y + other_pose[2, 2] * z
        depth = max(depth, -distance(field_at(model.grids, model.grid_of_link[other]), bx, by, bz))
    return depth
