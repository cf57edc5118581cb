"""Move open hands onto an object and close their fingers until they touch, in batches.

Both motions advance in conservative steps: no point of the hand moves farther than its signed
distance to the object, so no step can jump over a surface, however thin.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.hand import kinematics
from grasptypes.synthesis.fields import Field, distance
from grasptypes.synthesis.hand_model import FIRST_DISTAL, FIRST_PROXIMAL, HandModel
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]

MAX_STEPS = 60
_FINGERS = 3


def slide_in(
    scene: GraspScene, T_object_hand: Array, spread_rad: Array, reach_m: Array, touch_m: float
) -> Array:
    """Move open hands along their approach (+z) until they touch or have moved `reach_m`.

    Args:
        T_object_hand: (n, 4, 4) hands in the object frame, clear of the object.
        spread_rad: (n,) spread of the fingers.
        reach_m: (n,) maximum distance of each.
        touch_m: distance between surfaces at which a link stops.

    Returns:
        (n,) distance moved, metres.
    """
    angles = np.zeros((len(spread_rad), len(kinematics.JOINT_NAMES)))
    angles[:, :2] = spread_rad[:, None]
    poses = T_object_hand[:, None] @ kinematics.link_poses(angles)
    approach = np.ascontiguousarray(T_object_hand[:, :3, 2])
    return _slide(scene.hand, scene.field, poses, approach, reach_m, touch_m)


def close_fingers(
    scene: GraspScene, T_object_hand: Array, spread_rad: Array, touch_m: float
) -> Array:
    """Close each finger until it touches, like the real hand.

    Finger base and fingertip turn together, three to one. If the proximal link is stopped first,
    the TorqueSwitch lets the fingertip go on alone until it touches or reaches its limit.

    Args:
        T_object_hand: (n, 4, 4) hands in the object's frame.
        spread_rad: (n,).
        touch_m: distance between surfaces at which a link stops.

    Returns:
        (n, 8) joint angles in the order of `kinematics.JOINT_NAMES`, within their limits.
    """
    angles = np.zeros((len(spread_rad), len(kinematics.JOINT_NAMES)))
    angles[:, :2] = spread_rad[:, None]
    proximal = slice(FIRST_PROXIMAL, FIRST_PROXIMAL + _FINGERS)
    T_object_rest = T_object_hand[:, None] @ kinematics.link_poses(angles)[:, proximal]
    T_proximal_distal = kinematics.JOINTS[-1].T_parent_rest
    limits = kinematics.JOINT_LIMITS_RAD[[2, 5], 1]
    angles[:, 2:] = _close(
        scene.hand, scene.field, T_object_rest, T_proximal_distal, limits, touch_m
    )
    return angles


@compiled()
def _slide(
    model: HandModel, grid: Field, poses: Array, approach: Array, reach_m: Array, touch_m: float
) -> Array:
    travelled = np.zeros(len(poses))
    gaps = np.empty(len(model.points))
    for n in range(len(poses)):
        dx, dy, dz = approach[n]
        for link in range(len(model.radii)):
            gaps[model.starts[link] : model.starts[link + 1]] = _least_gap(
                model, grid, link, poses[n, link]
            )
        for _ in range(MAX_STEPS):
            x, y, z = travelled[n] * dx, travelled[n] * dy, travelled[n] * dz
            step = reach_m[n] - travelled[n]
            for link in range(len(model.radii)):
                for m in range(model.starts[link], model.starts[link + 1]):
                    if gaps[m] <= touch_m or gaps[m] < step:
                        px, py, pz = moved(poses[n, link], model.points, m)
                        gaps[m] = distance(grid, px + x, py + y, pz + z)
                        step = min(step, gaps[m])
            travelled[n] += max(step, 0.0)
            if step <= touch_m:
                break
            gaps -= step
    return travelled


@compiled()
def _least_gap(model: HandModel, grid: Field, link: int, pose: Array) -> float:
    """A lower bound on the distances of a link's points."""
    x, y, z = moved(pose, model.centres, link)
    return float(distance(grid, x, y, z) - model.radii[link])


@compiled(inline=True)
def moved(pose: Array, points: Array, row: int) -> tuple[float, float, float]:
    """One of the points (n, 3), transformed by a pose (3+, 4)."""
    x, y, z = points[row, 0], points[row, 1], points[row, 2]
    return (
        pose[0, 0] * x + pose[0, 1] * y + pose[0, 2] * z + pose[0, 3],
        pose[1, 0] * x + pose[1, 1] * y + pose[1, 2] * z + pose[1, 3],
        pose[2, 0] * x + pose[2, 1] * y + pose[2, 2] * z + pose[2, 3],
    )


@compiled(inline=True)
def _turned(pose: Array, angle: float, result: Array) -> None:
    """Rotate a pose (3+, 4) about its own z axis."""
    c, s = np.cos(angle), np.sin(angle)
    for row in range(3):
        result[row, 0] = c * pose[row, 0] + s * pose[row, 1]
        result[row, 1] = c * pose[row, 1] - s * pose[row, 0]
        result[row, 2] = pose[row, 2]
        result[row, 3] = pose[row, 3]


@compiled()
def _close(
    model: HandModel, grid: Field, T_object_rest: Array, T_proximal_distal: Array,
    limits: Array, touch_m: float,
) -> Array:  # fmt: skip
    fingers = T_object_rest.shape[1]
    angles = np.zeros((len(T_object_rest), 2 * fingers))
    for n in range(len(T_object_rest)):
        for finger in range(fingers):
            proximal, distal = _close_finger(
                model, grid, finger, T_object_rest[n, finger], T_proximal_distal, limits, touch_m
            )
            angles[n, finger] = proximal
            angles[n, fingers + finger] = distal
    return angles


@compiled()
def _close_finger(
    model: HandModel, grid: Field, finger: int, T_object_rest: Array, T_proximal_distal: Array,
    limits: Array, touch_m: float,
) -> tuple[float, float]:  # fmt: skip
    """Final angles of the two joints of a finger that starts open."""
    proximal, distal = FIRST_PROXIMAL + finger, FIRST_DISTAL + finger
    T_proximal, T_hinge, T_distal = np.empty((3, 4)), np.empty((3, 4)), np.empty((3, 4))
    ratio, hinge_m = kinematics.DISTAL_RATIO, kinematics.PROXIMAL_LENGTH_M
    own_levers = _levers(model, distal)
    proximal_levers, distal_levers = _levers(model, proximal), hinge_m + (1 + ratio) * own_levers
    _composed(T_object_rest, T_proximal_distal, T_distal)
    proximal_gaps, distal_gaps = np.empty(len(proximal_levers)), np.empty(len(distal_levers))
    proximal_gaps[:] = _least_gap(model, grid, proximal, T_object_rest)
    distal_gaps[:] = _least_gap(model, grid, distal, T_distal)
    angle, lead, released = 0.0, 0.0, False
    for _ in range(MAX_STEPS):
        _turned(T_object_rest, angle, T_proximal)
        _composed(T_proximal, T_proximal_distal, T_hinge)
        _turned(T_hinge, ratio * angle + lead, T_distal)
        if released:
            step = limits[1] - ratio * angle - lead
            step = _free_turn(model, grid, distal, T_distal, own_levers, distal_gaps, step, touch_m)
            if step <= 0.0:
                break
            lead += step
            distal_gaps -= step * own_levers
            continue
        step = _free_turn(
            model, grid, proximal, T_proximal, proximal_levers, proximal_gaps,
            limits[0] - angle, touch_m,
        )  # fmt: skip
        if step <= 0.0:
            released = True
            continue
        step = _free_turn(model, grid, distal, T_distal, distal_levers, distal_gaps, step, touch_m)
        if step <= 0.0:
            break
        angle += step
        proximal_gaps -= step * proximal_levers
        distal_gaps -= step * distal_levers
    return angle, ratio * angle + lead


@compiled()
def _levers(model: HandModel, link: int) -> Array:
    """Distance of each of a link's points from its joint axis, its own z."""
    points = model.points[model.starts[link] : model.starts[link + 1]]
    return np.sqrt(points[:, 0] ** 2 + points[:, 1] ** 2)


@compiled()
def _composed(first: Array, second: Array, result: Array) -> None:
    for row in range(3):
        for column in range(4):
            result[row, column] = first[row, 3] if column == 3 else 0.0
            for k in range(3):
                result[row, column] += first[row, k] * second[k, column]


@compiled()
def _free_turn(
    model: HandModel, grid: Field, link: int, pose: Array, levers: Array, gaps: Array,
    step: float, touch_m: float,
) -> float:  # fmt: skip
    """How far a link can turn before one of its points could touch.

    Args:
        levers: (m,) maximum motion of each point, metres per radian.
        gaps: (m,) lower bounds on the distances of the points, updated lazily: a point is not
            checked again before the link could have moved that far.
        step: the largest result of interest, radians.

    Returns:
        at most `step`; 0 if the link touches.
    """
    first = model.starts[link]
    for m in range(len(levers)):
        if gaps[m] > touch_m and gaps[m] >= step * levers[m]:
            continue
        x, y, z = moved(pose, model.points, first + m)
        gaps[m] = distance(grid, x, y, z)
        if gaps[m] <= touch_m:
            return 0.0
        step = min(step, gaps[m] / levers[m])
    return step
