"""An object as the planner sees it: parts with roles, and how people hold them for each task."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from grasptypes.contact_maps.contact_map import ContactMap, MapTask, map_contacts
from grasptypes.contact_maps.hold import Hold
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.planning.demands import demanded_holds, given_up, given_up_line
from grasptypes.renders.mesh_views import MESH_WORD
from grasptypes.segmentation.known_parts import known_parts
from grasptypes.segmentation.parts import Parts
from grasptypes.segmentation.role_files import RoleTable
from grasptypes.settings.params import Params

CENTIMETRES = 100.0


@dataclass(frozen=True)
class TaskContacts:
    """Where people hold an object for a task.

    Attributes:
        holds: ways of holding, with probabilities that add up to one; empty if people hold none of
            its parts.
        contact_map: None without holds.
        given_up: parts that the task wants untouched, and that hands may touch nevertheless.
    """

    task: str
    holds: Sequence[Hold]
    contact_map: ContactMap | None
    given_up: Sequence[str]

    def shares(self) -> list[tuple[str, str, float]]:
        """Grip, parts and probability of each way of holding, the most likely first."""
        return sorted(
            ((hold.grip, hold.part, hold.probability) for hold in self.holds),
            key=lambda each: -each[2],
        )


@dataclass(frozen=True)
class Inspection:
    """What is known about an object.

    Attributes:
        drawn: the points on its surface to which `parts` belong.
        mass_given: whether somebody said what it weighs.
        tasks: in the order asked for.
    """

    geometry: ObjectGeometry
    drawn: MapTask
    parts: Parts
    mass_given: bool
    tasks: tuple[TaskContacts, ...]

    def summary(self) -> dict[str, Any]:
        """Plain values for JSON; lengths in metres."""
        properties = self.geometry.properties
        low, high = np.array(properties.bounds_m)
        return {
            "object": properties.object,
            "extents_m": [round(float(extent), 5) for extent in high - low],
            "volume_m3": properties.volume_m3,
            "mass_kg": properties.mass_kg,
            "mass_given": self.mass_given,
            "repairs": properties.repairs,
            **self.parts.summary(),
            "tasks": {
                each.task: [
                    {"grip": grip, "part": part, "probability": round(share, 3)}
                    for grip, part, share in each.shares()
                ]
                for each in self.tasks
            },
            "given_up": {each.task: list(each.given_up) for each in self.tasks},
        }


def inspect_object(
    geometry: ObjectGeometry,
    tasks: Sequence[str],
    params: Params,
    *,
    roles: RoleTable | None = None,
    mass_given: bool = False,
) -> Inspection:
    """Find an object's parts, and where people hold them.

    Args:
        roles: roles of parts by name or colour; default: those in the object's file, or those that
            its shape tells.
        mass_given: whether the object's mass is known.

    Raises:
        InputError: nobody can hold the parts that people touch for a task.
    """
    settings = params.contact_maps
    drawn = MapTask.of_object(geometry, (MESH_WORD, ""), params.seed, settings)
    parts = known_parts(geometry, drawn.points, params.segmentation, roles)
    found = []
    for task in tasks:
        named = MapTask(
            drawn.points, drawn.part_names, (MESH_WORD, task), drawn.seed, drawn.scale, settings
        )
        seen, holds = demanded_holds(named, geometry, parts, params)
        touched = given_up(task, [part for hold in holds for part in hold.parts], parts, params)
        contact_map = map_contacts(seen, holds) if holds else None
        found.append(TaskContacts(task, holds, contact_map, touched))
    return Inspection(geometry, drawn, parts, mass_given, tuple(found))


def report(inspection: Inspection) -> str:
    """The inspection as text."""
    known = inspection.summary()
    size = " x ".join(f"{CENTIMETRES * extent:.1f}" for extent in known["extents_m"])
    mass = "given" if known["mass_given"] else "a solid of water; say what it weighs with --mass-kg"
    lines = [f"{known['object']}: {size} cm, {known['mass_kg']:.3g} kg ({mass})"]
    lines += [f"repaired: {repair}" for repair in known["repairs"]]
    lines += [
        "",
        f"roles from {known['basis']}",
        f"{'part':20}{'role':18}{'sure':>5}{'surface':>9}",
    ]
    for part in known["parts"]:
        role = part["role"] or "-"
        notes = f"  {', '.join(part['attributes'])}" if part["attributes"] else ""
        lines.append(
            f"{part['part']:20}{role:18}{part['confidence']:5.2f}{part['area_share']:9.1%}{notes}"
        )
    for task, holds in known["tasks"].items():
        lines.append("")
        if not holds:
            lines.append(
                f"{task}: people hold none of these parts; a plan takes every place as equally good"
            )
        for number, hold in enumerate(holds):
            head = f"{task}:" if number == 0 else ""
            lines.append(f"{head:12}{hold['probability']:5.0%}  {hold['grip']:9}{hold['part']}")
        if touched := known["given_up"][task]:
            lines.append(given_up_line(task, touched))
    return "\n".join(lines) + "\n"
