"""Which grasp a session gets: its candidates go through physics by rank until one is valid and
still has the shape of the person's grip. If none has, the valid one that left it least is taken.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_map import ContactMap
from grasptypes.hand import configuration, kinematics
from grasptypes.hand.shapes import depth_in_hand
from grasptypes.seeds import rng, seed
from grasptypes.synthesis.candidates import Person
from grasptypes.synthesis.energy import closeness
from grasptypes.synthesis.grasps import ENERGY_TERMS
from grasptypes.synthesis.grip_shape import ShapeRanges, ShapeSettings, deviation
from grasptypes.synthesis.hand_model import FIRST_DISTAL, FIRST_PROXIMAL, HandModel
from grasptypes.synthesis.holding import Contact
from grasptypes.synthesis.physics import Physics
from grasptypes.synthesis.search import Ranked, SearchSettings, Thing, search_session

Array = NDArray[np.float64]

LOGGER = logging.getLogger("grasptypes")


class ValiditySettings(NamedTuple):
    """What a valid grasp must keep to, beside holding the object."""

    max_depth_m: float
    """Depth of hand and object, or of two links, in each other, beyond which it is invalid."""
    strict_depth_m: float
    """A stricter depth that is reported too."""
    min_links: int
    """Links that must touch."""
    touch_m: float
    """Distance up to which a planned finger touches."""
    limit_tolerance_rad: float
    """How far a joint may be beyond its limit."""
    lag_tolerance_rad: float
    """How far a fingertip may be behind where its finger's base would have it."""


class Hand(NamedTuple):
    """The hand at two resolutions."""

    search: HandModel
    """Coarse, for thousands of candidates."""
    check: HandModel
    """Fine, for the verdict."""


class Trial(NamedTuple):
    """What became of one grasp."""

    reason: str
    """One of `grasps.REASONS`, or empty."""
    T_object_hand: Array
    """(4, 4): as held at the end, or as planned if it was not held."""
    joint_angles_rad: Array
    """(8,) likewise."""
    penetration_m: float
    moved_m: float
    turned_rad: float
    contacts: list[Contact]
    deviation: float = 0.0
    """Of that hand from the shape of the person's grip, see `grip_shape.deviation`."""


class Grip(NamedTuple):
    """What a held hand is compared with."""

    model: HandModel
    ranges: ShapeRanges
    settings: ShapeSettings


class Problem(NamedTuple):
    """The sessions of one object and task."""

    object_name: str
    task: str
    thing: Thing
    contact_map: ContactMap
    seed: int


def synthesize(
    problem: Problem, hand: Hand, world: Physics, search: SearchSettings,
    validity: ValiditySettings,
) -> tuple[pd.DataFrame, pd.DataFrame]:  # fmt: skip
    """One grasp a session.

    Returns:
        Tables that meet `grasps.GRASP_SCHEMA` and `grasps.ATTEMPT_SCHEMA`.
    """
    grasps: list[Mapping[str, Any]] = []
    attempts: list[Mapping[str, Any]] = []
    for number, person in enumerate(people(problem.contact_map), start=1):
        key = (problem.object_name, problem.task, number, problem.seed)
        ranked = search_session(hand.search, problem.thing, person, search, rng("synthesis", *key))
        grip = Grip(hand.search, search.shapes[person.grip], search.grip_shape)
        trials = list(_until_kept(ranked, problem.thing, hand.check, world, validity, grip))
        best = _best(trials)
        rows = [_row(key, rank, ranked, trial, validity) for rank, trial in enumerate(trials)]
        attempts.extend({**row, "chosen": rank == best} for rank, row in enumerate(rows))
        grasps.append(
            {**rows[best], "tries": len(rows), "grip": person.grip, **_contacts(trials[best])}
        )
        reasons = ", ".join(trial.reason or "valid" for trial in trials)
        LOGGER.info("%s %s session %d (%s): %s", *key[:3], person.grip, reasons)
    return pd.DataFrame(grasps), pd.DataFrame(attempts)


def people(contact_map: ContactMap) -> Iterator[Person]:
    """The persons of a contact map, in the order of its sessions."""
    points = contact_map.points.astype(np.float64)
    normals = contact_map.normals.astype(np.float64)
    for session in range(len(contact_map.sessions)):
        yield Person(
            points_m=points,
            normals=normals,
            contact=contact_map.sessions[session].astype(np.float64),
            grip=str(contact_map.grip[session]),
            approach=contact_map.approach[session].astype(np.float64),
            closing=contact_map.closing[session].astype(np.float64),
            centre_m=contact_map.centre_m[session].astype(np.float64),
        )


def try_grasp(
    T_object_hand: Array, joint_angles_rad: Array, thing: Thing, model: HandModel,
    world: Physics, validity: ValiditySettings,
) -> Trial:  # fmt: skip
    """Look at a grasp as planned; if nothing is wrong, test it, and look at it again as held."""
    reason, depth = _flaw(T_object_hand, joint_angles_rad, thing, model, validity)
    planned = Trial(reason, T_object_hand, joint_angles_rad, depth, 0.0, 0.0, [])
    if reason:
        return planned
    held = world.hold(T_object_hand, joint_angles_rad)
    if held.dropped:
        return planned._replace(reason="dropped", moved_m=held.moved_m, turned_rad=held.turned_rad)
    angles = held.joint_angles_rad.copy()
    angles[:2] = angles[:2].mean()  # one motor turns both spreads; the test holds each by itself
    angles = np.clip(angles, *kinematics.JOINT_LIMITS_RAD.T)
    reason, depth = _flaw(held.T_object_hand, angles, thing, model, validity)
    if _beyond_limits(held.joint_angles_rad, validity):
        reason = "joint_limit"
    elif not reason and len({contact.link for contact in held.contacts}) < validity.min_links:
        reason = "no_contact"
    return Trial(
        reason, held.T_object_hand, angles, depth, held.moved_m, held.turned_rad, held.contacts
    )


def _until_kept(
    ranked: Ranked, thing: Thing, model: HandModel, world: Physics, validity: ValiditySettings,
    grip: Grip,
) -> Iterator[Trial]:  # fmt: skip
    for T_object_hand, angles in zip(*ranked.hands, strict=True):
        trial = try_grasp(T_object_hand, angles, thing, model, world, validity)
        poses = trial.T_object_hand @ kinematics.link_poses(trial.joint_angles_rad)
        left = deviation(
            grip.model, thing.grid, poses[None], trial.joint_angles_rad[None], grip.ranges,
            grip.settings,
        )  # fmt: skip
        yield trial._replace(deviation=float(left[0]))
        if not trial.reason and left[0] <= grip.settings.kept:
            return


def _best(trials: Sequence[Trial]) -> int:
    """The last trial if it kept the grip, else the valid one that left it least, else the first."""
    valid = [rank for rank, trial in enumerate(trials) if not trial.reason]
    return min(valid, key=lambda rank: trials[rank].deviation, default=0)


def _flaw(
    T_object_hand: Array, angles: Array, thing: Thing, model: HandModel,
    validity: ValiditySettings,
) -> tuple[str, float]:  # fmt: skip
    """What is wrong with a pose by geometry alone, and how deep hand and object lie in each other.

    Points of the hand are looked for in the object and points of the object in the hand: a thin
    wall can cut into a link between the points of either.
    """
    poses = T_object_hand @ kinematics.link_poses(angles)
    close = closeness(model, thing.grid, poses[None])
    depth = max(float(close.penetration_m[0]), depth_in_hand(thing.surface_m, poses))
    if _beyond_limits(angles, validity):
        return "joint_limit", depth
    if close.self_depth_m[0] > validity.max_depth_m:
        return "self_collision", depth
    if depth > validity.max_depth_m:
        return "penetrates", depth
    fingers = close.gaps_m[0, FIRST_PROXIMAL:FIRST_DISTAL], close.gaps_m[0, FIRST_DISTAL:]
    touching = np.minimum(*fingers) <= validity.touch_m
    return ("" if touching.any() else "no_contact"), depth


def _beyond_limits(angles: Array, validity: ValiditySettings) -> bool:
    limits = kinematics.JOINT_LIMITS_RAD
    beyond = kinematics.beyond_limits(angles, limits, validity.limit_tolerance_rad).any()
    return bool(beyond or kinematics.lag(angles).max() > validity.lag_tolerance_rad)


def _row(
    key: tuple[str, str, int, int], rank: int, ranked: Ranked, trial: Trial,
    validity: ValiditySettings,
) -> Mapping[str, Any]:  # fmt: skip
    numbers = configuration.pack(rank, trial.T_object_hand, trial.joint_angles_rad[[0, 2, 3, 4]])
    terms = ranked.terms[rank]
    return {
        "object": key[0],
        "task": key[1],
        "session": key[2],
        "rank": rank,
        "energy": float(terms.sum()),
        **dict(zip(ENERGY_TERMS, terms.tolist(), strict=True)),
        "hand_configuration": numbers.tolist(),
        "joint_angles_rad": trial.joint_angles_rad.tolist(),
        "penetration_m": trial.penetration_m,
        "moved_m": trial.moved_m,
        "turned_rad": trial.turned_rad,
        "grip_deviation": trial.deviation,
        "valid": not trial.reason,
        "valid_strict": not trial.reason and trial.penetration_m <= validity.strict_depth_m,
        "reason": trial.reason,
        "seed": seed("synthesis", *key),
    }


def _contacts(trial: Trial) -> Mapping[str, Any]:
    points = [number for contact in trial.contacts for number in contact.point_m.tolist()]
    normals = [number for contact in trial.contacts for number in contact.normal.tolist()]
    return {
        "contact_links": [kinematics.LINK_NAMES[contact.link] for contact in trial.contacts],
        "contact_points_m": points,
        "contact_normals": normals,
        "contact_forces_n": [contact.force_n for contact in trial.contacts],
    }
