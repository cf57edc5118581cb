"""Where a plan's hands touch: where a scan is warm, or anywhere, with the grips of given types."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

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
) -> ContactMap:
    """Sessions of a prepared object, each with one of the grips in turn.

    Args:
        folder: of the object's files.
        scan: a measured contact map and its unit's length in metres. Without one every place is as
            good as any other, as in the rows of the affinity table whose part is `*`.
        grips: of the affinity table.
        name: object and task.
        params: the `contact_maps` section of params.yaml.

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
        path, probability = name[0], np.ones(len(points.points_m))
        # Nothing to agree with: the first placement that opposes is as good as any.
        free = {"placements": params["tries"], "sharpness": 0.0}
        params = {**params, "measured": {**params["measured"], **free}}
    people = [
        _session(points, probability, grips, (*name, number, seed_number), params, scale, path)
        for number in range(1, params["sessions"] + 1)
    ]
    return of_sessions(points, [str(part) for part in mesh.part_names], probability, people)


def _session(
    points: Points,
    probability: NDArray[np.float64],
    grips: Sequence[str],
    key: tuple[str, str, int, int],
    params: Mapping[str, Any],
    scale: float,
    path: str | Path,
) -> Session:
    """A session with the grip whose turn it is, or with any of them where that one is in vain."""
    drawn = (points, probability, key, params, scale, path)
    try:
        return draw_measured_session(*drawn, grips=[grips[key[2] % len(grips)]])
    except InputError:
        return draw_measured_session(*drawn, grips=grips)
