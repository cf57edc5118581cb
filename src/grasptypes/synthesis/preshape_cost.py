"""Cost of deviating from the preshape of the person's grip.

A contact map says where to hold, not how: closed fingers may cover the same surface from one side
where the person's came from three. The measures are those that distinguish grasp types, see
`grasp_type`, computed on the search's coarse hand.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.hands.description import ShapeRanges
from grasptypes.hands.hand import PALM
from grasptypes.labels.grasp_type import enclosed_diameters
from grasptypes.settings.synthesis import ShapeSettings
from grasptypes.synthesis.fields import Field, distance, gradient
from grasptypes.synthesis.hand_model import HandModel
from grasptypes.synthesis.posed_links import moved
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]


def preshape_cost(
    scene: GraspScene,
    link_poses: Array,
    joint_positions: Array,
    ranges: ShapeRanges,
    settings: ShapeSettings,
) -> Array:
    """Sum over the measures of the deviation from their ranges, as a share of the bound.

    Args:
        link_poses: (n, L, 4, 4) links in the object's frame.
        joint_positions: (n, J) of the same hands.

    Returns:
        (n,) 0 to 3; each measure counts at most 1.
    """
    gap, share = _palm_and_push(
        scene.model, scene.field, link_poses, settings.reach_m, settings.closing_weight
    )
    diameter = np.median(enclosed_diameters(scene.hand, joint_positions), axis=1)
    allowed = (ranges.palm_gap_m, ranges.enclosed_diameter_m, ranges.sideways_share)
    total = np.zeros(len(link_poses))
    for values, (least, most) in zip((gap, diameter, share), allowed, strict=True):
        below, above = (least - values) / max(least, 1e-9), (values - most) / max(most, 1e-9)
        total += np.clip(np.maximum(below, above), 0.0, 1.0)
    return total


@compiled()
def _palm_and_push(
    model: HandModel, grid: Field, poses: Array, reach_m: float, closing_weight: float
) -> tuple[Array, Array]:
    """Palm gaps (n,) and sideways shares (n,)."""
    gaps, shares = np.empty(len(poses)), np.zeros(len(poses))
    for n in range(len(poses)):
        gaps[n], _ = _nearest(model, grid, PALM, poses[n, PALM])
        total = 0.0
        for link in range(len(model.radii)):
            if model.base_of_link[link] < 0:
                continue
            gap, point = _nearest(model, grid, link, poses[n, link])
            if gap >= reach_m:
                continue
            push = _push(grid, point, poses[n, model.base_of_link[link]], closing_weight)
            along = 0.0
            for k in range(3):
                along += push[k] * poses[n, PALM, k, 0]
            weight = min(1.0 - gap / reach_m, 1.0)
            total += weight
            shares[n] += weight * along * along
        if total > 0.0:
            shares[n] /= total
    return gaps, shares


@compiled()
def _nearest(
    model: HandModel, grid: Field, link: int, pose: Array
) -> tuple[float, tuple[float, float, float]]:
    """Gap of a link, and its point closest to the object."""
    least, nearest = np.inf, (0.0, 0.0, 0.0)
    for index in range(model.starts[link], model.starts[link + 1]):
        point = moved(pose, model.points, index)
        gap = distance(grid, point[0], point[1], point[2])
        if gap < least:
            least, nearest = gap, point
    return least, nearest


@compiled()
def _push(grid: Field, point: tuple[float, float, float], base: Array, weight: float) -> Array:
    """Unit push at a point of a finger whose first joint turns about the z axis of `base`."""
    gx, gy, gz = gradient(grid, point[0], point[1], point[2])
    norm = max(np.sqrt(gx * gx + gy * gy + gz * gz), 1e-12)
    ax, ay, az = base[0, 2], base[1, 2], base[2, 2]
    rx, ry, rz = point[0] - base[0, 3], point[1] - base[1, 3], point[2] - base[2, 3]
    push = np.array([ay * rz - az * ry, az * rx - ax * rz, ax * ry - ay * rx])
    push *= weight / max(np.sqrt(np.sum(push * push)), 1e-12)
    push -= np.array([gx, gy, gz]) / norm
    unit: Array = push / max(np.sqrt(np.sum(push * push)), 1e-12)
    return unit
