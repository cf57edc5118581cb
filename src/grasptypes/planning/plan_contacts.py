"""Where a plan's hands touch: where a scan is warm, or anywhere, with the grips of given types."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_evidence import GRIP_OF_TYPE
from grasptypes.contact_maps.contact_map import (
    ContactMap,
    Points,
    Session,
    of_sessions,
    sample_surface,
)
from grasptypes.contact_maps.measured_contacts import draw_measured_session, read_probability
from grasptypes.errors import InputError
from grasptypes.objects.object_files import PROPERTIES, SURFACE, read_properties, read_surface
from grasptypes.seeds import seed


class PlanContacts(NamedTuple):
    """Where the hands of a plan touch."""

    contact_map: ContactMap
    numbers: tuple[int, ...]
    """Of its sessions, from 1; those that found no place to hold are left out."""


def grips_of(types: Sequence[str]) -> tuple[str, ...]:
    """The grips people use for some of `grasp_type.GRASP_TYPES`, each once."""
    return tuple(dict.fromkeys(GRIP_OF_TYPE[kind] for kind in types))


def plan_contacts(
    folder: str | Path,
    scan: tuple[str | Path, float] | None,
    grips: Sequence[str],
    name: tuple[str, str],
    seed_number: int,
    params: Mapping[str, Any],
    mesh_file: str | Path,
) -> PlanContacts:
    """Sessions of a prepared object, each with one of the grips in turn.

    A session whose hand finds no place to hold is left out; the others stay what they are.

    Args:
        folder: of the object's files.
        scan: a measured contact map and its unit's length in metres. Without one every place is as
            good as any other, as in the rows of the affinity table whose part is `*`.
        grips: of the affinity table.
        name: the object's word, which the draws depend on, and the task.
        params: the `contact_maps` section of params.yaml.
        mesh_file: the user's, or the object's name: to be named if no hand can hold it.

    Raises:
        InputError: the scan cannot be used, or no hand can hold the object.
    """
    mesh = read_surface(Path(folder) / SURFACE)
    scale = read_properties(Path(folder) / PROPERTIES)["scale"]
    surface_seed = seed("surface", name[0], seed_number) % 2**31
    points = sample_surface(
        mesh.vertices, mesh.faces, mesh.part_index, params["points"], surface_seed
    )
    if scan:
        path, metres = scan
        probability = read_probability(path, scale * metres, points, params)
    else:
        probability = np.ones(len(points.points_m))
        # Nothing to agree with: the first placement that opposes is as good as any.
        free = {"placements": params["tries"], "sharpness": 0.0}
        params = {**params, "measured": {**params["measured"], **free}}
    people = {}
    for number in range(1, params["sessions"] + 1):
        key = (*name, number, seed_number)
        person = _session(points, probability, grips, key, params, scale, mesh_file)
        if person:
            people[number] = person
    if not people:
        where = f"where {scan[0]} is warm" if scan else "anywhere"
        size_m = np.ptp(mesh.vertices, axis=0).max()
        raise InputError(
            mesh_file,
            "",
            f"no hand can hold it {where} with the grips {', '.join(grips)}: in "
            f"{params['sessions']} sessions thumb and fingers found no two sides; ask for other "
            f"types (--type), or check the unit (--unit): it is {size_m:.3g} m long",
        )
    part_names = [str(part) for part in mesh.part_names]
    found = of_sessions(points, part_names, probability, list(people.values()))
    return PlanContacts(found, tuple(people))


def _session(
    points: Points,
    probability: NDArray[np.float64],
    grips: Sequence[str],
    key: tuple[str, str, int, int],
    params: Mapping[str, Any],
    scale: float,
    path: str | Path,
) -> Session | None:
    """A session with the grip whose turn it is, or else with any of them, or None in vain."""
    turn = (grips[key[2] % len(grips)],)
    for choice in dict.fromkeys([turn, tuple(grips)]):  # with one grip the draws would be the same
        try:
            return draw_measured_session(
                points, probability, key, params, scale, path, grips=choice
            )
        except InputError:
            continue
    return None
