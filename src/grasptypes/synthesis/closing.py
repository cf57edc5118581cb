"""Move open hands onto an object and close their fingers until they touch, in batches.

Both motions advance in conservative steps: no point of the hand moves farther than its signed
distance to the object, so no step can jump over a surface, however thin.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.hands.states import HandStates
from grasptypes.settings.synthesis import ClosingSettings
from grasptypes.synthesis.fields import Field, distance, field_at
from grasptypes.synthesis.hand_model import HandModel
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]

MAX_STEPS = 60
# Bisections of a motion that ends in the hand itself: a thousandth of it remains.
HALVINGS = 10


def slide_in(
    scene: GraspScene, T_object_hand: Array, preshape: Array, reach_m: Array, touch_m: float
) -> Array:
    """Move open hands along their approach (+z) until they touch or have moved `reach_m`.

    Args:
        T_object_hand: (n, 4, 4) hands in the object frame, clear of the object.
        preshape: (n, P) preshapes of the fingers.
        reach_m: (n,) maximum distance of each.
        touch_m: distance between surfaces at which a link stops.

    Returns:
        (n,) distance moved, metres.
    """
    hand = scene.hand
    poses = HandStates(hand, T_object_hand, hand.opened(preshape)).link_poses()
    approach = np.ascontiguousarray(T_object_hand[:, :3, 2])
    return _slide(scene.model, scene.field, poses, approach, reach_m, touch_m)


def close_fingers(
    scene: GraspScene, T_object_hand: Array, preshape: Array, settings: ClosingSettings
) -> HandStates:
    """Close each finger until it touches, like the real hand.

    The joints of a finger move at the rates of its description. If a link is stopped, it and those
    before it stay, and the others go on at their own rates until the last one touches or reaches
    its limit, or the palm or a finger that closed before if the hand's fingers end there.

    Args:
        T_object_hand: (n, 4, 4) hands in the object's frame.
        preshape: (n, P).

    Returns:
        Hands with joint positions within their limits.
    """
    hand = scene.hand
    positions = hand.preshaped(preshape)
    T_object_rest = T_object_hand[:, None] @ hand.link_poses(positions)
    closed = _close(
        scene.model, scene.field, T_object_rest, settings.touch_m, settings.self_depth_m
    )
    for row, finger in enumerate(hand.fingers):
        positions[:, list(finger.joints)] = closed[:, row, : len(finger.joints)]
    states = HandStates(hand, T_object_hand, positions)
    return _centred(states) if hand.self_centring else states


def _centred(states: HandStates) -> HandStates:
    """Hands that have given way until their fingers, which slide together, are equally closed.

    Each finger stays where it touches: the hand moves along its axis by what it closed too much.
    """
    hand, positions = states.hand, states.joint_positions.copy()
    joints = [finger.joints[0] for finger in hand.fingers]
    mean = positions[:, joints].mean(axis=1, keepdims=True)
    axes = hand.link_poses(positions)[:, [joint + 1 for joint in joints]][..., :3, 2]
    excess = positions[:, joints] - mean
    shift = np.einsum("nf,nfi->ni", excess, axes) / len(joints)
    positions[:, joints] = mean
    T_object_hand = states.T_object_hand.copy()
    T_object_hand[:, :3, 3] += np.einsum("nij,nj->ni", T_object_hand[:, :3, :3], shift)
    return HandStates(hand, T_object_hand, positions)


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


@compiled(inline=True)
def _moved_along(pose: Array, position: float, prismatic: bool, result: Array) -> None:
    """Turn a pose (3+, 4) about its own z axis, or slide it along."""
    c, s = np.cos(position), np.sin(position)
    for row in range(3):
        result[row, 2], result[row, 3] = pose[row, 2], pose[row, 3]
        if prismatic:
            result[row, 0], result[row, 1] = pose[row, 0], pose[row, 1]
            result[row, 3] += position * pose[row, 2]
        else:
            result[row, 0] = c * pose[row, 0] + s * pose[row, 1]
            result[row, 1] = c * pose[row, 1] - s * pose[row, 0]


@compiled()
def _close(
    model: HandModel, grid: Field, T_object_rest: Array, touch_m: float, self_depth_m: float
) -> Array:
    """Joint positions (n, F, M) of fingers; `T_object_rest` (n, L, 4, 4) are the links before."""
    fingers, longest = model.chains.links.shape
    positions = np.zeros((len(T_object_rest), fingers, longest))
    poses, gaps = np.empty((longest, 3, 4)), np.empty(len(model.points))
    travel = np.empty(longest)
    for n in range(len(T_object_rest)):
        T_object_links = T_object_rest[n].copy()
        for finger in range(fingers):
            links = model.chains.links[finger, : model.chains.counts[finger]]
            T_object_base = T_object_rest[n, links[0]]
            stage = _close_finger(
                model, grid, finger, T_object_base, touch_m, poses, gaps, travel,
                positions[n, finger],
            )  # fmt: skip
            if model.ends_at_hand:
                _leave_hand(
                    model, finger, T_object_links, T_object_base, stage, self_depth_m, poses,
                    travel, positions[n, finger],
                )  # fmt: skip
                for place in range(len(links)):
                    T_object_links[links[place], :3] = poses[place]
    return positions


@compiled()
def _close_finger(
    model: HandModel, grid: Field, finger: int, T_object_base: Array, touch_m: float,
    poses: Array, gaps: Array, travel: Array, positions: Array,
) -> int:  # fmt: skip
    """Close one finger, and return the number of stopped joints before its last motion.

    `poses` (M, 3, 4) and `gaps` (n,) are overwritten; `positions` (M,) and `travel` (M,), of each
    stage in units of its rates, are set.
    """
    chains = model.chains
    count, rates = chains.counts[finger], chains.rates[finger]
    travel[:] = 0.0
    stage = 0
    for step_number in range(MAX_STEPS):
        _set_positions(model, finger, travel, positions)
        _set_poses(model, finger, T_object_base, positions, poses)
        if step_number == 0:
            _bound_gaps(model, grid, finger, poses, gaps)
        room = chains.limits[finger, stage, 1] - chains.open[finger, stage]
        for done in range(stage + 1):
            room -= rates[done, stage] * travel[done]
        step, stopped = room / rates[stage, stage], -1
        for place in range(stage, count):
            step = _free_motion(
                model, grid, finger, stage, place, poses[place], gaps, step, touch_m
            )
            if step <= 0.0:
                stopped = place
                break
        if stopped >= 0:
            stage = stopped + 1
            if stage == count:
                break
            continue
        travel[stage] += step
        _narrow_gaps(model, finger, stage, step, gaps)
    _set_positions(model, finger, travel, positions)
    _set_poses(model, finger, T_object_base, positions, poses)
    last: int = min(stage, count - 1)
    return last


@compiled()
def _leave_hand(
    model: HandModel, finger: int, T_object_links: Array, T_object_base: Array, stage: int,
    self_depth_m: float, poses: Array, travel: Array, positions: Array,
) -> None:  # fmt: skip
    """Take the motions of a finger back, the last one first, if it is too deep in the hand."""
    if _depth_in_hand(model, finger, T_object_links, poses) <= self_depth_m:
        return
    for taken_back in range(stage, -1, -1):
        free, whole = 0.0, travel[taken_back]
        for halving in range(HALVINGS):
            travel[taken_back] = (free + 0.5**halving) * whole if halving else 0.0
            _set_positions(model, finger, travel, positions)
            _set_poses(model, finger, T_object_base, positions, poses)
            if _depth_in_hand(model, finger, T_object_links, poses) <= self_depth_m:
                free = travel[taken_back] / whole if whole > 0.0 else 0.0
            elif halving == 0:
                break
        else:
            travel[taken_back] = free * whole
            _set_positions(model, finger, travel, positions)
            _set_poses(model, finger, T_object_base, positions, poses)
            return


@compiled()
def _depth_in_hand(model: HandModel, finger: int, T_object_links: Array, poses: Array) -> float:
    """How deep links of a finger at (M, 3, 4) are in the palm and the fingers closed before."""
    links, depth = model.chains.links, 0.0
    for row in range(len(model.pairs)):
        link, other = model.pairs[row]
        if model.base_of_link[link] != links[finger, 0]:
            link, other = other, link
        before = model.base_of_link[other] < 0
        for closed in range(finger):
            before = before or model.base_of_link[other] == links[closed, 0]
        if model.base_of_link[link] == links[finger, 0] and before:
            for place in range(model.chains.counts[finger]):
                if links[finger, place] == link:
                    pose, other_pose = poses[place], T_object_links[other]
                    depth = max(
                        depth,
                        overlap(model, link, pose, other, other_pose),
                        overlap(model, other, other_pose, link, pose),
                    )
    return depth


@compiled()
def _bound_gaps(model: HandModel, grid: Field, finger: int, poses: Array, gaps: Array) -> None:
    """Start with one lower bound for all points of a link."""
    for place in range(model.chains.counts[finger]):
        link = model.chains.links[finger, place]
        least = _least_gap(model, grid, link, poses[place])
        gaps[model.starts[link] : model.starts[link + 1]] = least


@compiled()
def _narrow_gaps(model: HandModel, finger: int, stage: int, step: float, gaps: Array) -> None:
    """Lower the bounds by what the points of the moving links may have moved."""
    for place in range(stage, model.chains.counts[finger]):
        link = model.chains.links[finger, place]
        own = model.chains.own_levers[finger, stage, place]
        base = model.chains.base_levers[finger, stage, place]
        for m in range(model.starts[link], model.starts[link + 1]):
            gaps[m] -= step * (base + own * model.levers[m])


@compiled()
def _set_positions(model: HandModel, finger: int, travel: Array, positions: Array) -> None:
    """Joint positions after the travel of each stage; joints wait at their limits."""
    chains = model.chains
    count = chains.counts[finger]
    for place in range(count):
        position = 0.0
        for stage in range(count):
            position += chains.rates[finger, stage, place] * travel[stage]
        position += chains.open[finger, place]
        lower, upper = chains.limits[finger, place]
        positions[place] = min(max(position, lower), upper)


@compiled()
def _set_poses(
    model: HandModel, finger: int, T_object_rest: Array, positions: Array, poses: Array
) -> None:
    """Poses (M, 3, 4) of a finger's links at joint positions (M,)."""
    chains, rest = model.chains, np.empty((3, 4))
    for place in range(chains.counts[finger]):
        prismatic = chains.prismatic[finger, place]
        if place == 0:
            _moved_along(T_object_rest, positions[0], prismatic, poses[0])
            continue
        _compose(poses[place - 1], chains.T_parent_rest[finger, place], rest)
        _moved_along(rest, positions[place], prismatic, poses[place])


@compiled()
def _compose(first: Array, second: Array, result: Array) -> None:
    for row in range(3):
        for column in range(4):
            result[row, column] = first[row, 3] if column == 3 else 0.0
            for k in range(3):
                result[row, column] += first[row, k] * second[k, column]


@compiled()
def _free_motion(
    model: HandModel, grid: Field, finger: int, stage: int, place: int, pose: Array, gaps: Array,
    step: float, touch_m: float,
) -> float:  # fmt: skip
    """How far a finger can move before a point of one of its links could touch.

    Args:
        place: position of the link in its finger.
        gaps: (n,) lower bounds on the distances of the hand's points, updated lazily: a point is
            not checked again before the link could have moved that far.
        step: the largest result of interest, in units of the stage's rates.

    Returns:
        at most `step`; 0 if the link touches.
    """
    link = model.chains.links[finger, place]
    own = model.chains.own_levers[finger, stage, place]
    base = model.chains.base_levers[finger, stage, place]
    for m in range(model.starts[link], model.starts[link + 1]):
        lever = base + own * model.levers[m]
        if gaps[m] > touch_m and gaps[m] >= step * lever:
            continue
        x, y, z = moved(pose, model.points, m)
        gaps[m] = distance(grid, x, y, z)
        if gaps[m] <= touch_m:
            return 0.0
        if lever > 0.0:
            step = min(step, gaps[m] / lever)
    return step
