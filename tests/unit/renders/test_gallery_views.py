"""A grasp is seen from where neither object nor fingers are hidden; no OpenGL is needed."""

import numpy as np
import pytest
from tests.unit.barrett import BARRETT

from grasptypes.hands.states import HandStates
from grasptypes.renders.gallery_views import best_azimuth, finger_points


def block(centre_m: tuple[float, float, float]) -> np.ndarray:
    """Points that fill a cube of 10 cm, 5 mm apart."""
    axis = np.linspace(-0.05, 0.05, 21)
    return np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3) + centre_m


@pytest.mark.parametrize("turn_rad", [0.0, np.pi / 2])
def test_the_view_is_across_what_would_hide_the_other(turn_rad: float) -> None:
    cosine, sine = np.cos(turn_rad), np.sin(turn_rad)
    turn = np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])
    thing, fingers, rest = (block((x, 0.0, 0.0)) @ turn for x in (0.0, 0.12, 0.24))
    azimuth_rad = best_azimuth(thing, fingers, rest, elevation_rad=0.0)
    along = abs(np.cos(azimuth_rad - turn_rad))
    assert along < np.sin(np.pi / 4)


def test_the_hand_s_points_are_posed() -> None:
    T_object_hand = np.eye(4)
    T_object_hand[:3, 3] = 1.0, 2.0, 3.0
    angles_rad = np.zeros((1, len(BARRETT.joints)))
    at_origin = finger_points(HandStates(BARRETT, np.eye(4)[None], angles_rad))
    moved = finger_points(HandStates(BARRETT, T_object_hand[None], angles_rad))
    for before, after in zip(at_origin, moved, strict=True):
        assert after == pytest.approx(before + [1.0, 2.0, 3.0])
    fingers, rest = at_origin
    assert fingers[:, 2].max() > rest[:, 2].max()
