"""How people hold objects follows from roles, size and weight; laws, not numbers."""

import re
from dataclasses import replace

import numpy as np
import pytest
from tests.unit.contact_maps.shapes import box, held_object, mallet, rod
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.holds import find_holds, fit_factor, measures, palm_sides
from grasptypes.contact_maps.placement import HumanHand
from grasptypes.contact_maps.places import find_places
from grasptypes.settings.holds import HOLDS, check_tasks, read_hold_table
from grasptypes.settings.objects import CATALOGUE
from grasptypes.settings.roles import ROLES, read_roles
from grasptypes.settings.tasks import TASKS as TASK_FILE
from grasptypes.settings.tasks import read_tasks

TABLE, TASKS = read_hold_table(), read_tasks()
HAND = HumanHand.of_length(0.183, PARAMS.contact_maps.hand)


def holds(held, task="use", table=TABLE):
    return find_holds(held, TASKS[task], table, HAND)


def shares(held, task="use"):
    """Share of each grip."""
    grips = {}
    for hold in holds(held, task):
        grips[hold.grip] = grips.get(hold.grip, 0.0) + hold.probability
    return grips


def place(held, group, task="use"):
    found = find_places(held, TASKS[task], TABLE, HAND.breadth_m)
    return next(place for place in found if place.group == group)


@pytest.mark.parametrize("path", [ROLES, TASK_FILE, HOLDS])
def test_no_row_names_an_object(path):
    """Comments and reasons may cite objects as evidence; keys and values may not."""
    text = re.sub(r"#.*|\b(?:reason|meaning):(?:.*\n(?:\s{6,}.*\n)*)", "", path.read_text())
    words = set(re.findall(r"\w+", text))
    assert not words & set(CATALOGUE)


def test_every_role_is_in_a_group_unless_nobody_holds_it():
    check_tasks(TASKS, TABLE)
    grouped = {role for group in TABLE.groups.values() for role in group.roles}
    nobody = {"base", "hinge", "button", "switch", "screen", "fitting"}
    assert grouped | nobody == set(read_roles().roles)


def test_probabilities_add_up_and_no_grip_is_rare():
    for held in (mallet(), held_object([("b", "ball", (), rod(0.04, 0.08))])):
        for task in TASKS:
            found = holds(held, task)
            assert sum(hold.probability for hold in found) == pytest.approx(1.0 if found else 0.0)
            assert all(share >= TABLE.rarest for share in shares(held, task).values())


def test_a_light_handle_is_wrapped_and_a_heavy_one_lies_in_the_palm():
    light, heavy = shares(mallet(0.05)), shares(mallet(1.5))
    assert light["wrap"] > 0.5
    assert heavy["enclose"] > 2 * light.get("enclose", 0.0)
    assert heavy.get("pinch", 0.0) + heavy.get("tripod", 0.0) < light["pinch"] + light["tripod"]


def test_a_palmful_is_enclosed_and_a_thin_body_is_not():
    ball = shares(held_object([("b", "ball", (), rod(0.04, 0.08))]))
    bar = shares(held_object([("b", "grip_body", (), box((0.03, 0.16, 0.05)))]))
    assert ball["enclose"] > 0.5 > bar["enclose"]


def test_a_wide_container_is_wrapped_and_a_narrow_one_pinched():
    narrow = shares(held_object([("w", "container_wall", (), rod(0.03, 0.15))]))
    wide = shares(held_object([("w", "container_wall", (), rod(0.09, 0.09))]))
    assert narrow["pinch"] > narrow["wrap"]
    assert wide["wrap"] > wide.get("pinch", 0.0)


def test_only_a_rim_is_taken_by_the_rim_from_where_it_is():
    wall, rim = rod(0.07, 0.06), rod(0.07, 0.01, (0.0, 0.0, 0.035))
    closed = held_object([("wall", "container_wall", (), wall)])
    cup = held_object([("wall", "container_wall", (), wall), ("rim", "rim", (), rim)])
    assert "rim" not in shares(closed)
    side = palm_sides(cup, place(cup, "wall"), "rim", HAND)
    assert side == pytest.approx(np.array([[0.0, 0.0, 1.0]]), abs=0.05)


def test_blows_come_from_a_fist_at_the_far_end():
    strike = holds(mallet(), "strike")
    assert {hold.grip for hold in strike} == {"wrap", "enclose"}
    assert {hold.parts for hold in strike} == {("handle",)}
    assert all((hold.low, hold.high) == TASKS["strike"].position for hold in strike)
    assert all(hold.axis[2] < -0.9 for hold in strike)


def test_what_stays_free_is_not_touched():
    for hold in holds(mallet(), "strike"):
        assert hold.touchable == ("handle",)
    hot = mallet(attributes=("hot",))
    assert all("head" not in hold.touchable for hold in holds(hot) if "head" not in hold.parts)


def test_the_palm_is_not_where_other_parts_are():
    sides = palm_sides(mallet(), place(mallet(), "handle"), "enclose", HAND)
    # From below and all around the handle, not through the head.
    assert sides[:, 2].min() < -0.9
    assert sides[:, 2].max() < 0.1
    assert len(sides) == 9


def test_load_grows_with_weight_and_lever():
    near = place(mallet(), "end", "handoff")
    light, heavy = (
        measures(mallet(kg), near, TASKS["handoff"], TABLE, HAND)["load_n"] for kg in (0.1, 0.2)
    )
    assert heavy == pytest.approx(2 * light)
    far = measures(mallet(0.1), place(mallet(), "handle"), TASKS["strike"], TABLE, HAND)
    assert far["load_n"] > light


def test_lengths_are_relative_to_the_hand():
    held = mallet()
    larger = replace(
        held, points_m=1.15 * held.points_m, centre_of_mass_m=1.15 * held.centre_of_mass_m
    )
    hand = HumanHand.of_length(1.15 * 0.183, PARAMS.contact_maps.hand)
    values = [
        measures(each, place(each, "handle"), TASKS["use"], TABLE, of)
        for each, of in ((held, HAND), (larger, hand))
    ]
    assert values[0] == pytest.approx(values[1])


def test_a_fit_changes_nothing_below_its_size():
    fit = TABLE.fits[0]
    assert fit_factor({fit.measure: 0.5 * fit.at}, [fit]) == 1.0
    assert fit_factor({fit.measure: 2 * fit.at}, [fit]) == pytest.approx(2**fit.power)
