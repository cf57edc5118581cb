"""Contact maps of simple bodies, where a hand must lie is known."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.contact_map import (
    MapTask,
    draw_session,
    map_contacts,
    sample_surface,
)
from grasptypes.contact_maps.hold import Hold
from grasptypes.errors import InputError
from grasptypes.objects.object_files import Surface
from grasptypes.settings.contact_maps import HandLengths

SETTINGS = PARAMS.contact_maps
SMALL = SETTINGS.changed(sessions=4, population=6)
RADIUS_M, HEIGHT_M = 0.03, 0.30
NAMES = ["lower", "upper"]
UP = np.array([0.0, 0.0, 1.0])
WRAP = Hold(("upper",), ("upper",), "wrap", None, UP, 0.4, 0.6, 1.0)


@pytest.fixture(scope="module")
def bottle():
    """A tube, 60 mm across, of a lower and an upper part of 150 mm each."""
    mesh = trimesh.creation.cylinder(RADIUS_M, HEIGHT_M, sections=64)
    mesh = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(mesh.vertices, mesh.faces, 0.02))
    part = (mesh.vertices[:, 2] > 0).astype(np.int16)
    return sample_surface(Surface(mesh.vertices, mesh.faces, part, NAMES), 2500, 1)


def task(points, settings=SETTINGS, seed=0, names=NAMES):
    return MapTask(points, names, ("bottle", "use"), seed, 1.0, settings)


def _draw(bottle, hold, session=1, settings=SETTINGS):
    return draw_session(task(bottle, settings), [hold], session)


@pytest.mark.parametrize("session", range(1, 6))
def test_wrap_goes_around_the_held_part_a_hand_high(bottle, session):
    drawn = _draw(bottle, WRAP, session)
    touched = bottle.points_m[drawn.contact >= SETTINGS.threshold]
    assert touched[:, 2].min() > -0.005
    assert 0.8 < np.ptp(touched[:, 2]) / drawn.hand.breadth_m < 1.6
    angles = np.sort(np.arctan2(touched[:, 1], touched[:, 0]))
    assert np.degrees(np.diff(angles, append=angles[0] + 2 * np.pi).max()) < 60


@pytest.mark.parametrize("session", range(1, 6))
def test_pinch_touches_two_sides_with_fingertips(bottle, session):
    drawn = _draw(bottle, replace(WRAP, grip="pinch"), session)
    touched = drawn.contact >= SETTINGS.threshold
    side = bottle.normals[touched] @ drawn.placement.closing
    assert (side > 0.35).any()
    assert (side < -0.35).any()
    assert (np.abs(side) > 0.35).mean() > 0.9
    # One thumb and up to four fingers.
    pad_m2 = np.pi * drawn.hand.pad_radius_m**2
    area_m2 = 2 * np.pi * RADIUS_M * (RADIUS_M + HEIGHT_M) * touched.mean()
    assert 1.5 * pad_m2 < area_m2 < 6.5 * pad_m2


def test_larger_hands_touch_more(bottle):
    touched = []
    for length_m in (0.15, 0.22):
        people = (HandLengths(hand_length_m=length_m, hand_length_sd_m=0.0),)
        drawn = _draw(bottle, WRAP, 1, SETTINGS.changed(people=people))
        touched.append(drawn.contact.sum())
    assert touched[1] > 1.2 * touched[0]


def test_holds_come_up_in_proportion_to_their_probability(bottle):
    holds = [replace(WRAP, probability=0.7), replace(WRAP, grip="pinch", probability=0.3)]
    many = SETTINGS.changed(sessions=20, population=20)
    drawn = map_contacts(task(bottle, many), holds)
    assert 13 <= (drawn.style == "power").sum() <= 15


def test_a_session_is_the_same_whatever_is_drawn_beside_it(bottle):
    few = map_contacts(task(bottle, SMALL), [WRAP])
    more = map_contacts(task(bottle, SMALL.changed(sessions=6)), [WRAP])
    other = map_contacts(task(bottle, SMALL, 1), [WRAP])
    assert np.array_equal(few.sessions, more.sessions[:4])
    assert np.array_equal(few.probability, more.probability)
    assert not np.array_equal(few.sessions, other.sessions)
    assert len(np.unique(few.sessions, axis=0)) == 4


def test_an_object_that_nobody_can_hold_is_named(bottle):
    thick = replace(bottle, points_m=bottle.points_m * 10)
    with pytest.raises(InputError, match=r"bottle and use.*no opposing sides \(pinch upper\)"):
        _draw(thick, replace(WRAP, grip="pinch"))


def test_who_cannot_hold_it_one_way_holds_it_another_way(bottle):
    # Around the lower end, where the hand may touch nothing.
    impossible = replace(WRAP, parts=("lower",), grip="pinch", low=0.0, high=0.0, probability=0.99)
    holds = [impossible, replace(WRAP, probability=0.01)]
    assert {draw_session(task(bottle), holds, n).hold.grip for n in range(1, 5)} == {"wrap"}


def test_a_hand_reaches_what_it_may_touch_beside_the_held_part(bottle):
    low = replace(WRAP, low=0.0, high=0.0)
    alone, beside = _draw(bottle, low), _draw(bottle, replace(low, touchable=("lower", "upper")))
    lower = bottle.points_m[:, 2] < -0.005
    assert alone.contact[lower].max() == 0
    assert beside.contact[lower].max() > SETTINGS.threshold


def test_rim_is_pinched_through_its_wall():
    mesh = trimesh.creation.annulus(0.07, 0.075, 0.08, sections=64)
    mesh = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(mesh.vertices, mesh.faces, 0.02))
    part = np.zeros(len(mesh.vertices), np.int16)
    points = sample_surface(Surface(mesh.vertices, mesh.faces, part, ["wall"]), 6000, 1)
    hold = Hold((), (), "rim", UP[None], UP, 0.9, 0.9, 1.0)
    drawn = draw_session(task(points, names=["wall"]), [hold], 1)
    touched = points.points_m[drawn.contact >= SETTINGS.threshold]
    radius = np.hypot(touched[:, 0], touched[:, 1])
    assert radius.min() < 0.0715
    assert radius.max() > 0.0735
    assert touched[:, 2].min() > 0.0
