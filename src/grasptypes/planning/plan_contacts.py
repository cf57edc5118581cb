"""Where the hands of a plan touch: on parts that people hold, where a scan is warm, or anywhere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_map import (
    ContactMap,
    MapTask,
    Session,
    draw_session,
    of_sessions,
)
from grasptypes.contact_maps.hold import GRIP_OF_TYPE, Hold
from grasptypes.contact_maps.measured_contacts import draw_measured_session, read_probability
from grasptypes.errors import InputError
from grasptypes.hands.hand import Hand
from grasptypes.objects.contact_scan import ContactScan, read_contact_scan


class MeasuredMap(NamedTuple):
    """A user's contact map."""

    path: Path
    unit_m: float
    """Length of its unit, metres."""

    def read(self) -> ContactScan:
        """Its points; raises InputError if the file cannot be used."""
        return read_contact_scan(*self)


class PlanContacts(NamedTuple):
    """The contacts of a plan."""

    contact_map: ContactMap
    numbers: tuple[int, ...]
    """Session numbers, from 1; sessions that found no place to hold are left out."""
    avoided: tuple[str, ...] = ()
    """Names of the parts that hands should not touch; grasps that do are the last resort."""

    @property
    def held_parts(self) -> set[str]:
        """Names of the parts that somebody holds."""
        return {name for held in self.contact_map.part for name in str(held).split("+")}


def grips_of(types: Sequence[str]) -> tuple[str, ...]:
    """The grips that people use for some of `grasp_type.GRASP_TYPES`, without duplicates."""
    return tuple(dict.fromkeys(GRIP_OF_TYPE[kind] for kind in types))


def missing_types(hand: Hand, types: Sequence[str] = tuple(GRIP_OF_TYPE)) -> list[str]:
    """Those of the grasp types whose grip the hand cannot perform."""
    return [kind for kind in types if GRIP_OF_TYPE[kind] in hand.grips.instead]


def hold_parts(task: MapTask, holds: Sequence[Hold], grips: Sequence[str]) -> PlanContacts | None:
    """Sessions with the holds of an object's parts, as often as people choose them.

    Args:
        task: whose points have these parts, see `part_holds`.
        grips: grips to use; if people use none of them on this object, they use their own.

    Returns:
        None if there are no holds, or nobody can hold the object in any of these ways.
    """
    kept = [hold for hold in holds if hold.grip in grips] or list(holds)
    people = {}
    for number in range(1, task.settings.sessions + 1) if kept else ():
        try:
            people[number] = draw_session(task, kept, number)
        except InputError:  # in no placement do thumb and fingers find opposing sides
            continue
    if not people:
        return None
    probability = np.mean([person.contact for person in people.values()], axis=0)
    return PlanContacts(of_sessions(task, probability, list(people.values())), tuple(people))


def plan_contacts(
    task: MapTask, measured: MeasuredMap | None, grips: Sequence[str], source: str | Path
) -> PlanContacts:
    """Sessions of a prepared object, with the grips in turn.

    A session whose hand finds no place to hold is left out; the other sessions are not affected.

    Args:
        measured: without it all places are equally likely.
        grips: grips to use.
        source: the user's mesh or the object's name, for errors.

    Raises:
        InputError: the measured map cannot be used, or no hand can hold the object.
    """
    if measured:
        probability = read_probability(*measured, task)
    else:
        probability = np.ones(len(task.points.points_m))
        task = _anywhere(task)
    people = {}
    for number in range(1, task.settings.sessions + 1):
        person = _session(task, probability, grips, number)
        if person:
            people[number] = person
    if not people:
        where = f"where {measured.path} is warm" if measured else "anywhere"
        size_m = np.ptp(task.points.points_m, axis=0).max()
        raise InputError(
            source,
            "",
            f"no hand can hold it {where} with the grips {', '.join(grips)}: in "
            f"{task.settings.sessions} sessions thumb and fingers found no opposing sides; "
            f"request other types (--type), or check the unit (--unit): it is {size_m:.3g} m long",
        )
    return PlanContacts(of_sessions(task, probability, list(people.values())), tuple(people))


def _anywhere(task: MapTask) -> MapTask:
    """A task without a map to match: the first opposing placement is as good as any."""
    settings = task.settings
    free = settings.measured.changed(placements=settings.tries, sharpness=0.0)
    return replace(task, settings=settings.changed(measured=free))


def _session(
    task: MapTask, probability: NDArray[np.float64], grips: Sequence[str], number: int
) -> Session | None:
    """A session with the grip whose turn it is, else with any of them, else None."""
    turn = (grips[number % len(grips)],)
    # With a single grip the draws would be the same.
    choices = dict.fromkeys([turn, tuple(grips)])
    found = (draw_measured_session(task, probability, number, choice) for choice in choices)
    return next((session for session in found if session), None)
