"""In handoff a plan leaves handles to the receiver and keeps off blades, where that is possible."""

from types import SimpleNamespace

import pytest
from tests.unit.contact_maps.shapes import mallet
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.planning.demands import demanded_holds, demands, given_up, hold_as_demanded
from grasptypes.segmentation.parts import Parts
from grasptypes.settings.roles import PartRole
from grasptypes.settings.tasks import read_tasks

GRIPS = ("wrap", "enclose", "tripod", "pinch")


def seen(task, head):
    """The geometry, drawn points and parts of a mallet whose head has a role of its own."""
    held = mallet()
    points = SurfacePoints(held.points_m, held.normals, held.part_index)
    roles = {**held.roles, "head": PartRole.check({"role": head})}
    drawn = MapTask(points, list(roles), ("mallet", task), 0, 1.0, PARAMS.contact_maps)
    weight = SimpleNamespace(mass_kg=held.mass_kg, centre_of_mass_m=held.centre_of_mass_m.tolist())
    parts = Parts(held.part_index, roles, dict.fromkeys(roles, 1.0), "its shape")
    return drawn, SimpleNamespace(properties=weight), parts


def test_only_a_task_with_a_receiver_demands_more_than_people_do():
    assert demands("use", PARAMS) == [read_tasks()["use"]]
    assert demands("handoff", PARAMS)[-1] == read_tasks()["handoff"]


@pytest.mark.parametrize(
    ("task", "head", "held", "touched", "avoided"),
    [
        ("use", "head", {"handle", "head"}, [], ()),
        ("use", "working_end", {"handle"}, [], ("head",)),
        ("handoff", "head", {"head"}, [], ()),
        # Beside the handle there is nothing better.
        ("handoff", "working_end", {"head"}, ["head"], ()),
        # Nothing is left to hold but the handle, or the blade.
        ("handoff", "blade", {"handle"}, ["handle"], ("head",)),
    ],
)
def test_plans_hold_what_the_receiver_does_not_want_or_say_so(task, head, held, touched, avoided):
    drawn, geometry, parts = seen(task, head)
    holds = demanded_holds(drawn, geometry, parts, PARAMS)[1]
    assert {part for hold in holds for part in hold.parts} == held
    plan = hold_as_demanded(drawn, geometry, parts, GRIPS, PARAMS)
    assert given_up(task, plan.held_parts, parts, PARAMS) == touched
    assert plan.avoided == avoided
    contacts = plan.contact_map
    free = [name for name in parts.roles if name not in held]
    for name in free:
        on_part = contacts.part_index == list(parts.roles).index(name)
        assert contacts.sessions[:, on_part].max() == 0
