"""How people hold an object whose parts were found in its shape, and may be mistaken."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.contact_maps.hold import Hold
from grasptypes.contact_maps.holds import find_holds
from grasptypes.contact_maps.places import HeldObject
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.segmentation.parts import Parts
from grasptypes.settings.holds import HoldTable, read_hold_table
from grasptypes.settings.roles import PartRole
from grasptypes.settings.segmentation import PartSettings
from grasptypes.settings.tasks import Task


def part_holds(
    drawn: MapTask,
    geometry: ObjectGeometry,
    parts: Parts,
    task: Task,
    settings: PartSettings,
    table: HoldTable | None = None,
) -> tuple[MapTask, list[Hold]]:
    """The task of a contact map with these parts, and the holds for it; uncertain parts get less
    weight.

    Args:
        drawn: its points are those of `parts`.
        task: what the object is held for.
        table: default: the table that comes with the package.

    Returns:
        The holds are empty if no part has a role that the task touches.
    """
    seen = replace(
        drawn,
        points=replace(drawn.points, part_index=parts.part_index),
        part_names=list(parts.roles),
    )
    held = HeldObject(
        drawn.points.points_m,
        drawn.points.normals,
        parts.part_index,
        _without_crumbs(parts, settings.minor_share),
        geometry.properties.mass_kg,
        np.array(geometry.properties.centre_of_mass_m),
    )
    holds = find_holds(held, task, table or read_hold_table(), drawn.typical_hand())
    sure = [
        replace(hold, probability=hold.probability * _confidence(parts, hold.parts))
        for hold in holds
    ]
    total = sum(hold.probability for hold in sure)
    return seen, [replace(hold, probability=hold.probability / total) for hold in sure]


def _without_crumbs(parts: Parts, minor_share: float) -> Mapping[str, PartRole | None]:
    """The roles without those of small parts beside a large one.

    Roles that somebody stated stay, and those that warn the hand.
    """
    sizes = dict(
        zip(parts.roles, np.bincount(parts.part_index, minlength=len(parts.roles)), strict=True)
    )
    largest: dict[str, int] = {}
    for name, part in parts.roles.items():
        if part:
            largest[part.role] = max(largest.get(part.role, 0), sizes[name])
    return {
        name: part
        if part
        and (
            parts.confidence[name] == 1
            or part.hazardous
            or sizes[name] >= minor_share * largest[part.role]
        )
        else None
        for name, part in parts.roles.items()
    }


def _confidence(parts: Parts, names: tuple[str, ...]) -> float:
    return float(np.mean([parts.confidence[name] for name in names]))
