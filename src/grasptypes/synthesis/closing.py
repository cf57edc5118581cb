"""Close the fingers of hands until they touch an object, in batches, in steps like `approach`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.hands.states import HandStates
from grasptypes.settings.synthesis import ClosingSettings
from grasptypes.synthesis.approach import MAX_STEPS
from grasptypes.synthesis.fields import Field, distance
from grasptypes.synthesis.hand_model import HandModel
from grasptypes.synthesis.posed_links import least_gap, moved, overlap
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]

# Bisections of a motion that ends in the hand itself: a thousandth of it remains.
HALVINGS = 10


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
    return states.centred() if hand.self_centring else states


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
        _place(model, finger, T_object_base, travel, positions, poses)
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
    _place(model, finger, T_object_base, travel, positions, poses)
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
            _place(model, finger, T_object_base, travel, positions, poses)
            if _depth_in_hand(model, finger, T_object_links, poses) <= self_depth_m:
                free = travel[taken_back] / whole if whole > 0.0 else 0.0
            elif halving == 0:
                break
        else:
            travel[taken_back] = free * whole
            _place(model, finger, T_object_base, travel, positions, poses)
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
        least = least_gap(model, grid, link, poses[place])
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
def _place(
    model: HandModel, finger: int, T_object_base: Array, travel: Array, positions: Array,
    poses: Array,
) -> None:  # fmt: skip
    """Set joint positions (M,) and poses (M, 3, 4) of a finger after the travel of each stage."""
    _set_positions(model, finger, travel, positions)
    _set_poses(model, finger, T_object_base, positions, poses)


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
