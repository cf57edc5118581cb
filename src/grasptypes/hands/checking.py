"""What a description of a hand may have wrong although it can be read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.description import GRIPS
from grasptypes.hands.hand import PALM, Hand, beyond
from grasptypes.hands.links import Finger
from grasptypes.hands.states import HandStates
from grasptypes.hands.surface import depth_in_link, surface_points

Array = NDArray[np.float64]

# Motion of a joint that shows its direction.
TRIAL_RAD, TRIAL_M = 0.1, 0.002
# How far a position may lie outside its limits, which descriptions round.
LIMIT_RAD, LIMIT_M = 1e-3, 1e-4
# Bullet keeps links 1 mm apart; a hub may reach that far into its neighbour's neighbour.
DEPTH_M = 0.001
SPACING_M = 0.004
# Rounded angles of descriptions; five degrees change an enclosed diameter by a tenth.
ANGLE_RAD = 0.09


def check_hand(hand: Hand) -> list[str]:
    """Everything that looks wrong with a hand, one line each; empty if nothing does."""
    found = [
        *_links(hand),
        *_preshapes(hand),
        *(line for finger in hand.fingers for line in _finger(hand, finger)),
        *_sides(hand),
    ]
    # Links of a hand that is wrong otherwise may overlap for that reason.
    return found or list(_collisions(hand))


def open_states(hand: Hand, preshapes: Sequence[Sequence[float]]) -> HandStates:
    """Open hands with these preshapes, at the origin."""
    positions = hand.opened(preshapes)
    return HandStates(hand, np.tile(np.eye(4), (len(positions), 1, 1)), positions)


def preshapes(hand: Hand) -> list[tuple[float, ...]]:
    """All different preshapes of the grips."""
    found = [
        tuple(preshape)
        for name in GRIPS
        if name not in hand.grips.instead
        for preshape in hand.grips.named(name).preshapes
    ]
    return list(dict.fromkeys(found))


def _links(hand: Hand) -> Iterator[str]:
    for link in hand.links:
        moments = np.linalg.eigvalsh(link.inertia_kg_m2)
        if moments.min() <= 0 or moments[2] > moments[:2].sum() * 1.01:
            yield f"link {link.name}: no rigid body has this inertia (principal moments {moments})"
        if not link.visuals:
            yield f"link {link.name}: has no visual shape: pictures do not show it"


def _preshapes(hand: Hand) -> Iterator[str]:
    limits = hand.dof_limits[: len(hand.preshape)]
    for name, (low, high) in zip(hand.preshape, limits, strict=True):
        if low > high:
            yield f"preshape {name}: its joints' limits leave no common range"
    for preshape in preshapes(hand):
        values = np.array(preshape)
        tolerance = np.where(hand.prismatic_dofs[: len(hand.preshape)], LIMIT_M, LIMIT_RAD)
        for index in np.flatnonzero(beyond(values, limits, tolerance)):
            name, (low, high) = list(hand.preshape)[index], limits[index]
            yield f"grips: {name} = {values[index]:g} is not between {low:.4g} and {high:.4g}"


def _finger(hand: Hand, finger: Finger) -> Iterator[str]:
    """Its open position, direction of closing, coupling and angles."""
    limits = hand.joint_limits[list(finger.joints)]
    tolerance = np.where(hand.prismatic_joints[list(finger.joints)], LIMIT_M, LIMIT_RAD)
    shut = beyond(finger.open, limits, tolerance)
    for name, start, (low, high), wrong in zip(
        _names(hand, finger), finger.open, limits, shut, strict=True
    ):
        if wrong:
            yield f"joint {name}: opens at {start:g}, outside its limits {low:.4g} to {high:.4g}"
            return
    state = open_states(hand, [preshapes(hand)[0]])
    column = hand.fingers.index(finger)
    before = hand.fingertips(state.joint_positions)[0, column]
    for joint, name in zip(finger.joints, _names(hand, finger), strict=True):
        positions = state.joint_positions.copy()
        positions[0, joint] += TRIAL_M if hand.joints[joint].prismatic else TRIAL_RAD
        after = hand.fingertips(positions)[0, column]
        # A closing joint moves the tip forwards, inwards, or both.
        inwards = np.linalg.norm(before[:2]) - np.linalg.norm(after[:2])
        if max(inwards, after[2] - before[2]) <= 0:
            yield f"joint {name}: opens finger {finger.name}: reverse its axis"
    travel = (limits[0, 1] - finger.open[0]) / finger.rates[0, 0]
    ends = finger.open + finger.rates[0] * travel
    past = beyond(ends, limits, tolerance) & (not hand.direct)
    for name, end, (low, high), wrong in zip(_names(hand, finger), ends, limits, past, strict=True):
        if wrong:
            yield f"joint {name}: the coupling drives it to {end:.4g}, beyond {low:.4g}, {high:.4g}"
    for name, said, seen in zip(
        _names(hand, finger), finger.bend_rad, _bends(hand, finger), strict=True
    ):
        if abs(np.angle(np.exp(1j * (said - seen)))) > ANGLE_RAD:
            yield f"joint {name}: bend_rad is {said:.4g}, but its links are at {seen:.4g}"


def _names(hand: Hand, finger: Finger) -> list[str]:
    return [hand.joint_names[joint] for joint in finger.joints]


def _bends(hand: Hand, finger: Finger) -> Array:
    """Exterior angles (m,) of a finger's links at position zero, in its closing plane."""
    positions = hand.preshaped(np.array(preshapes(hand)[0]))
    poses, tips = hand.link_poses(positions), hand.fingertips(positions)
    axis = poses[finger.links[0], :3, 2]
    points = [poses[link, :3, 3] for link in finger.links] + [tips[hand.fingers.index(finger)]]
    if hand.joints[finger.joints[0]].prismatic:
        return np.array([np.pi / 2])
    up = np.array([0.0, 0.0, 1.0]) - axis[2] * axis
    out = np.cross(up, axis)
    along = np.diff(points, axis=0)
    angles = np.arctan2(along @ up, along @ out)
    return np.asarray(np.diff(angles, prepend=0.0))


def _sides(hand: Hand) -> Iterator[str]:
    """Thumbs are at -y, and the fingers reach in front of the palm."""
    tips = hand.fingertips(open_states(hand, [preshapes(hand)[0]]).joint_positions)[0]
    thumbs = np.array([finger.thumb for finger in hand.fingers])
    if tips[thumbs, 1].mean() >= tips[~thumbs, 1].mean():
        yield "palm: thumbs must be at -y of the hand's frame, other fingers at +y: turn the frame"
    closed = hand.couple(np.concatenate([preshapes(hand)[0], _half_closed(hand)]))
    if hand.fingertips(closed)[:, 2].min() <= 0:
        yield "palm: half-closed fingers are behind it: z must point from the palm to the object"


def _half_closed(hand: Hand) -> Array:
    return np.asarray(hand.dof_limits[len(hand.preshape) :].mean(axis=1))


def _collisions(hand: Hand) -> Iterator[str]:
    """Links of the open hand that overlap."""
    surface = surface_points(hand, SPACING_M)
    states = open_states(hand, preshapes(hand))
    joined = {(joint.parent, index + 1) for index, joint in enumerate(hand.joints)}
    found: dict[tuple[int, int], float] = {}
    for poses in states.link_poses():
        for link, T in enumerate(poses):
            points = surface.points_m[surface.link_index == link]
            in_hand = points @ T[:3, :3].T + T[:3, 3]
            for other in range(len(hand.links)):
                pair = min(link, other), max(link, other)
                if link == other or pair in joined | hand.ignored_pairs:
                    continue
                local = (in_hand - poses[other, :3, 3]) @ poses[other, :3, :3]
                depth_m = depth_in_link(hand.links[other], local).max()
                found[pair] = max(found.get(pair, 0.0), float(depth_m))
    for pair, depth_m in found.items():
        if depth_m > DEPTH_M:
            names = " and ".join(hand.link_names[link] for link in pair)
            where = "the palm" if PALM in pair else "each other"
            yield f"links {names}: {1e3 * depth_m:.1f} mm into {where} when open"
