"""Where a plan's hands touch: where a scan is warm, or anywhere, with the grips of given types."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_evidence import GRIP_OF_TYPE
from grasptypes.contact_maps.contact_map import ContactMap, MapTask, Session, of_sessions
from grasptypes.contact_maps.measured_contacts import draw_measured_session, read_probability
from grasptypes.errors import InputError
from grasptypes.objects.contact_scan import ContactScan, read_contact_scan


class MeasuredMap(NamedTuple):
    """A user's contact map."""

    path: Path
    unit_m: float
    """Length of its unit."""

    def read(self) -> ContactScan:
        """Its points; raises InputError if the file cannot be used."""
        return read_contact_scan(*self)


class PlanContacts(NamedTuple):
    """Where the hands of a plan touch."""

    contact_map: ContactMap
    numbers: tuple[int, ...]
    """Of its sessions, from 1; those that found no place to hold are left out."""


def grips_of(types: Sequence[str]) -> tuple[str, ...]:
    """The grips people use for some of `grasp_type.GRASP_TYPES`, each once."""
    return tuple(dict.fromkeys(GRIP_OF_TYPE[kind] for kind in types))


def plan_contacts(
    task: MapTask, measured: MeasuredMap | None, grips: Sequence[str], source: str | Path
) -> PlanContacts:
    """Sessions of a prepared object, each with one of the grips in turn.

    A session whose hand finds no place to hold is left out; the others stay what they are.

    Args:
        measured: without one every place is as good as any other, as in the rows of the affinity
            table whose part is `*`.
        grips: of the affinity table.
        source: the user's mesh, or the object's name: to be named if no hand can hold it.

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
    """With nothing to agree with, the first placement that opposes is as good as any."""
    settings = task.settings
    free = settings.measured.changed(placements=settings.tries, sharpness=0.0)
    return replace(task, settings=settings.changed(measured=free))


def _session(
    task: MapTask, probability: NDArray[np.float64], grips: Sequence[str], number: int
) -> Session | None:
    """A session with the grip whose turn it is, or else with any of them, or None in vain."""
    turn = (grips[number % len(grips)],)
    # With one grip the draws would be the same.
    choices = dict.fromkeys([turn, tuple(grips)])
    found = (draw_measured_session(task, probability, number, choice) for choice in choices)
    return next((session for session in found if session), None)
