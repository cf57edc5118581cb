"""Where a person puts the hand on a stick, whose axes are known."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.handprint import handprint
from grasptypes.contact_maps.hold import Hold
from grasptypes.contact_maps.placement import HeldSurface, HumanHand, place_hand
from grasptypes.settings.contact_maps import PlacementSettings

SETTINGS = PARAMS.contact_maps
HAND = HumanHand.of_length(0.19, SETTINGS.hand)
STILL = PlacementSettings(tilt_sd_rad=0.0, roll_sd_rad=0.0, slice_m=0.01, depth_m=0.01)
UP = np.array([0.0, 0.0, 1.0])
HOLD = Hold((), (), "wrap", None, UP, 0.25, 0.25, 1.0)
GRIPS = ["wrap", "enclose", "tripod", "pinch", "rim"]


@pytest.fixture(scope="module")
def stick():
    """A stick along z from 0 to 0.2 m, 30 mm thick; its upper tenth must not be touched."""
    mesh = trimesh.creation.cylinder(0.015, 0.2, sections=48)
    points, faces = trimesh.sample.sample_surface(mesh, 6000, seed=0)
    points = points + [0, 0, 0.1]
    return HeldSurface(points, mesh.face_normals[faces], points[:, 2] < 0.18)


@pytest.mark.parametrize("grip", GRIPS)
@pytest.mark.parametrize("seed", range(3))
def test_palm_side_axis_and_closing_stand_at_right_angles(stick, grip, seed):
    settings = STILL.changed(tilt_sd_rad=0.2, roll_sd_rad=0.2)
    place, height = place_hand(
        stick, replace(HOLD, grip=grip), HAND, settings, np.random.default_rng(seed)
    )
    frame = np.array([place.palm_side, place.axis, place.closing])
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-9)
    assert height == 0.25
    assert 2 <= place.fingers <= 4


def test_the_centre_is_in_the_middle_at_the_height_that_the_hold_names(stick):
    place, _ = place_hand(stick, HOLD, HAND, STILL, np.random.default_rng(0))
    np.testing.assert_allclose(place.centre_m, [0, 0, 0.25 * 0.18], atol=1e-3)
    assert abs(place.palm_side[2]) < 1e-9
    assert abs(place.axis[2]) == pytest.approx(1.0)


def test_the_palm_comes_from_the_side_that_the_hold_names(stick):
    hold = replace(HOLD, grip="enclose", sides=np.array([[-1.0, 0.0, 0.0]]))
    place, _ = place_hand(stick, hold, HAND, STILL, np.random.default_rng(0))
    np.testing.assert_allclose(place.palm_side, [-1, 0, 0], atol=1e-9)


@pytest.mark.parametrize("grip", ["wrap", "enclose", "tripod", "pinch"])
def test_a_hand_touches_only_what_it_may_and_near_its_centre(stick, grip):
    place, _ = place_hand(stick, replace(HOLD, grip=grip), HAND, STILL, np.random.default_rng(1))
    contact = handprint(stick, grip, place, HAND)
    assert contact.max() > 0.5
    assert contact.min() >= 0
    assert contact.max() <= 1
    assert not contact[~stick.mask].any()
    touched = stick.points_m[contact > 0.5]
    assert np.abs(touched[:, 2] - place.centre_m[2]).max() < HAND.breadth_m
