"""A quick test, before any physics, of whether the contacts could hold the object still.

Contacts whose normal forces sum to one newton, each within its friction cone, leave some wrench
unbalanced. The smallest possible residual is the minimum norm in the convex hull of the wrenches
along the cones' edges with unit normal force; it is zero if and only if the origin is in the hull
(force closure, up to the boundary). Gilbert's algorithm approaches it from above, so the result
after a finite number of steps is an upper bound. (E. G. Gilbert, An iterative procedure for
computing the minimum of a quadratic form on a convex set, SIAM J. Control 4(1), 1966.)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.settings.synthesis import EquilibriumSettings
from grasptypes.synthesis.fields import Field, distance, gradient
from grasptypes.synthesis.hand_model import Indices
from grasptypes.synthesis.posed_links import moved
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]


def wrench_residual(scene: GraspScene, link_poses: Array, settings: EquilibriumSettings) -> Array:
    """Wrench that stays unbalanced when each of n hands presses with normal forces of 1 N in total.

    Torques are about the object's centre of mass and are converted to forces at its radius.

    Args:
        link_poses: (n, L, 4, 4) links in the object's frame.

    Returns:
        (n,) newtons, an upper bound, 0 (balanced) to 1; 1 if nothing touches.
    """
    model = scene.model
    return _wrench_residuals(
        *(model.points, model.starts, model.centres, model.radii, scene.field, link_poses),
        *(scene.centre_of_mass_m, scene.radius_m),
        *(settings.friction, settings.cone_edges, settings.contact_m, settings.iterations),
    )


@compiled()
def _wrench_residuals(
    points: Array, starts: Indices, centres: Array, radii: Array, grid: Field, poses: Array,
    centre: Array, radius: float, friction: float, edges: int, contact_m: float, iterations: int,
) -> Array:  # fmt: skip
    result = np.ones(len(poses))
    wrenches = np.empty((len(points) * edges, 6))
    for n in range(len(poses)):
        count = 0
        for link in range(len(radii)):
            cx, cy, cz = moved(poses[n, link], centres, link)
            if distance(grid, cx, cy, cz) - radii[link] > contact_m:
                continue
            for index in range(starts[link], starts[link + 1]):
                x, y, z = moved(poses[n, link], points, index)
                if distance(grid, x, y, z) <= contact_m:
                    gx, gy, gz = gradient(grid, x, y, z)
                    arm = (x - centre[0], y - centre[1], z - centre[2])
                    _cone(wrenches, count, arm, (-gx, -gy, -gz), radius, friction, edges)
                    count += edges
        if count > 0:
            result[n] = min(1.0, _least_norm(wrenches[:count], iterations))
    return result


@compiled()
def _cone(
    wrenches: Array, first: int, arm: tuple[float, float, float],
    normal: tuple[float, float, float], radius: float, friction: float, edges: int,
) -> None:  # fmt: skip
    """Wrenches along the edges of a friction cone, 1 N along the normal; torques per `radius`."""
    nx, ny, nz = normal
    if abs(nx) < 0.6:
        ux, uy, uz = 0.0, nz, -ny
    else:
        ux, uy, uz = -nz, 0.0, nx
    length = np.sqrt(ux * ux + uy * uy + uz * uz)
    ux, uy, uz = ux / length, uy / length, uz / length
    vx, vy, vz = ny * uz - nz * uy, nz * ux - nx * uz, nx * uy - ny * ux
    for edge in range(edges):
        angle = 2.0 * np.pi * edge / edges
        c, s = friction * np.cos(angle), friction * np.sin(angle)
        fx, fy, fz = nx + c * ux + s * vx, ny + c * uy + s * vy, nz + c * uz + s * vz
        row = wrenches[first + edge]
        row[0], row[1], row[2] = fx, fy, fz
        row[3] = (arm[1] * fz - arm[2] * fy) / radius
        row[4] = (arm[2] * fx - arm[0] * fz) / radius
        row[5] = (arm[0] * fy - arm[1] * fx) / radius


@compiled()
def _least_norm(points: Array, iterations: int) -> float:
    """Upper bound on the distance of the origin from the convex hull of points (n, d)."""
    current = points[0].copy()
    for _ in range(iterations):
        lowest, best = np.inf, 0
        for row in range(len(points)):
            value = 0.0
            for k in range(points.shape[1]):
                value += points[row, k] * current[k]
            if value < lowest:
                lowest, best = value, row
        square, along = 0.0, 0.0
        for k in range(points.shape[1]):
            difference = points[best, k] - current[k]
            square += difference * difference
            along -= difference * current[k]
        if along <= 0.0 or square == 0.0:
            break
        step = min(1.0, along / square)
        for k in range(points.shape[1]):
            current[k] += step * (points[best, k] - current[k])
    return float(np.sqrt(np.sum(current * current)))
