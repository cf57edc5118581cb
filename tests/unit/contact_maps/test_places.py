"""Places follow from roles: which parts, along which axis, and how large."""

import numpy as np
import pytest
from tests.unit.contact_maps.shapes import box, held_object, mallet, rod
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.places import find_places
from grasptypes.settings.holds import read_hold_table
from grasptypes.settings.tasks import read_tasks

TABLE, TASKS = read_hold_table(), read_tasks()
BREADTH_M = 0.183 * PARAMS.contact_maps.hand.breadth


def places(held, task="use"):
    return {place.group: place for place in find_places(held, TASKS[task], TABLE, BREADTH_M)}


def test_a_handle_points_away_from_the_head():
    found = places(mallet())
    assert found["handle"].parts == ("handle",)
    assert found["handle"].axis == pytest.approx([0, 0, -1], abs=0.02)
    assert found["handle"].extents_m == pytest.approx([0.2, 0.028, 0.028], abs=0.004)
    assert found["handle"].middle_m == pytest.approx([0, 0, 0.1], abs=0.004)


def test_a_task_weighs_roles():
    use, handoff = places(mallet()), places(mallet(), "handoff")
    share = {
        name: found["end"].weight / found["handle"].weight
        for name, found in (("use", use), ("handoff", handoff))
    }
    assert share["use"] < 0.2 < share["handoff"]


@pytest.mark.parametrize("attribute", ["hot", "sharp", "wet"])
def test_hands_keep_away_from_hazards(attribute):
    safe, hazardous = places(mallet()), places(mallet(attributes=(attribute,)))
    assert hazardous["end"].weight == pytest.approx(TASKS["use"].hazard * safe["end"].weight)
    assert "end" not in places(mallet(attributes=(attribute,)), "cut")


def test_parts_without_a_role_are_no_place():
    held = held_object([("body", None, (), rod(0.03, 0.1))])
    assert places(held) == {}


def test_fingers_go_around_a_bowl_and_along_a_bar_and_a_sheet():
    # Fingers have room side by side along the axis of symmetry of a can, not of a coin.
    can = held_object([("wall", "container_wall", (), rod(0.08, 0.09))])
    assert np.abs(places(can)["wall"].axis) == pytest.approx([0, 0, 1], abs=0.05)
    coin = held_object([("plate", "panel", (), rod(0.08, 0.01))])
    assert abs(places(coin)["body"].axis[2]) < 0.05
    bar = held_object([("bar", "grip_body", (), box((0.03, 0.16, 0.05)))])
    assert np.abs(places(bar)["body"].axis) == pytest.approx([0, 1, 0], abs=0.05)
    assert places(bar)["body"].extents_m == pytest.approx([0.16, 0.05, 0.03], abs=0.005)


def test_a_ball_is_compact_and_a_rod_is_not():
    ball = held_object([("flesh", "ball", (), rod(0.04, 0.08))])
    assert places(ball)["body"].compactness > 0.9
    assert places(mallet())["handle"].compactness < 0.2
