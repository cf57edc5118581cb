"""Holds of parts that may be mistaken: doubt lowers a probability, and crumbs are not held."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from tests.unit.contact_maps.shapes import mallet
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.segmentation.part_holds import part_holds
from grasptypes.segmentation.parts import Parts
from grasptypes.settings.tasks import read_tasks

TASK = read_tasks()["handoff"]


def drawn_and_parts(confidence):
    held = mallet()
    points = SurfacePoints(
        held.points_m, held.normals, np.zeros(len(held.points_m), dtype=np.int16)
    )
    drawn = MapTask(points, ["body"], ("mallet", "handoff"), 0, 1.0, PARAMS.contact_maps)
    return drawn, Parts(held.part_index, held.roles, confidence, "its shape")


def geometry():
    held = mallet()
    properties = SimpleNamespace(
        mass_kg=held.mass_kg, centre_of_mass_m=held.centre_of_mass_m.tolist()
    )
    return SimpleNamespace(properties=properties)


def share_of(holds, part):
    return sum(hold.probability for hold in holds if part in hold.parts)


def test_doubt_lowers_the_probability_of_a_hold():
    sure = {"handle": 1.0, "head": 1.0}
    drawn, parts = drawn_and_parts(sure)
    seen, holds = part_holds(drawn, geometry(), parts, TASK, PARAMS.segmentation)
    assert seen.part_names == list(parts.roles)
    assert sum(hold.probability for hold in holds) == pytest.approx(1)
    drawn, doubtful = drawn_and_parts(sure | {"handle": 0.2})
    rarely = part_holds(drawn, geometry(), doubtful, TASK, PARAMS.segmentation)[1]
    assert 0 < share_of(rarely, "handle") < share_of(holds, "handle")


def with_a_small_second_handle(confidence):
    drawn, parts = drawn_and_parts({"handle": 0.8, "head": 0.8, "handle_2": confidence})
    index = np.array(parts.part_index)
    on_head = np.flatnonzero(index == list(parts.roles).index("head"))
    index[on_head[:10]] = 2
    roles = {**parts.roles, "handle_2": parts.roles["handle"]}
    return drawn, replace(parts, part_index=index, roles=roles)


def test_a_crumb_beside_a_large_part_is_held_only_if_somebody_named_it():
    for confidence, held in ((0.8, False), (1.0, True)):
        drawn, crumbs = with_a_small_second_handle(confidence)
        holds = part_holds(drawn, geometry(), crumbs, TASK, PARAMS.segmentation)[1]
        assert share_of(holds, "handle") > 0
        assert (share_of(holds, "handle_2") > 0) == held


def test_nobody_holds_parts_without_a_role():
    drawn, parts = drawn_and_parts({"handle": 1.0, "head": 1.0})
    nothing = replace(parts, roles=dict.fromkeys(parts.roles))
    assert part_holds(drawn, geometry(), nothing, TASK, PARAMS.segmentation)[1] == []
