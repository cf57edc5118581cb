"""What a plan demands of a hold, beyond what people do: parts are offered to a receiver."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.contact_maps.hold import Hold
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.planning.plan_contacts import PlanContacts, hold_parts
from grasptypes.segmentation.part_holds import part_holds
from grasptypes.segmentation.parts import Parts
from grasptypes.settings.params import Params
from grasptypes.settings.tasks import Task, read_tasks

# Roles that are made for the hand, so that a receiver wants them.
HANDLES = ("handle", "bail", "strap")


def demands(name: str, params: Params) -> list[Task]:
    """A task as a plan understands it, the strictest way first, and as people do it last.

    Where parts are offered to a receiver, hands stay off these and off hazards.
    """
    task = read_tasks()[name]
    strict = [
        task.changed(
            touched={role: weight for role, weight in task.touched.items() if role not in free},
            free=(*task.free, *free),
            hazard=0.0,
        )
        for free in params.plan.offered.get(name, ())
    ]
    return [*strict, task]


def demanded_holds(
    drawn: MapTask, geometry: ObjectGeometry, parts: Parts, params: Params
) -> tuple[MapTask, list[Hold]]:
    """The holds for the strictest demand of a task for which there are any, see `part_holds`."""
    *strict, task = demands(drawn.name[1], params)
    for demand in strict:
        found = part_holds(drawn, geometry, parts, demand, params.segmentation)
        if found[1]:
            return found
    return part_holds(drawn, geometry, parts, task, params.segmentation)


def hold_as_demanded(
    drawn: MapTask, geometry: ObjectGeometry, parts: Parts, grips: Sequence[str], params: Params
) -> PlanContacts | None:
    """Sessions for the strictest demand of a task in which hands find places, see `hold_parts`."""
    for demand in demands(drawn.name[1], params):
        found = part_holds(drawn, geometry, parts, demand, params.segmentation)
        if contacts := hold_parts(*found, grips):
            return contacts._replace(avoided=_avoided(demand, contacts.held_parts, parts))
    return None


def _avoided(demand: Task, held: set[str], parts: Parts) -> tuple[str, ...]:
    """Parts that are hazardous, or that a demand leaves free, but for those that are held.

    A handle is not among them: a receiver's hand finds room beside a finger.
    """
    free = set(demand.free) - set(HANDLES)
    return tuple(
        name
        for name, part in parts.roles.items()
        if part
        and name not in held
        and (part.role in free or (part.hazardous and demand.hazard < 1))
    )


def given_up(task: str, held: Iterable[str], parts: Parts, params: Params) -> list[str]:
    """Those of the held parts that the strictest demand of a task leaves untouched."""
    strictest, names = demands(task, params)[0], set(held)
    return [
        name
        for name, part in parts.roles.items()
        if part
        and name in names
        and (part.role in strictest.free or (part.hazardous and not strictest.hazard))
    ]


def given_up_line(task: str, names: Sequence[str]) -> str:
    """The same for people."""
    return f"{task}: {', '.join(names)} cannot be left untouched, as nothing else can be held"
