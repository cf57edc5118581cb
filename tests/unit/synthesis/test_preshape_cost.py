import numpy as np
import pytest
from synthesis_cases import TOUCH_M, closed, scene_of
from tests.unit.barrett import BARRETT

from grasptypes.hands.description import ShapeRanges
from grasptypes.settings.synthesis import ShapeSettings
from grasptypes.synthesis.approach import slide_in
from grasptypes.synthesis.preshape_cost import preshape_cost

SETTINGS = ShapeSettings(reach_m=0.025, closing_weight=3.0, weight=1.0, kept=0.2)
ANY = (-1.0, 1.0)


def of(spread_rad, back_off_m=0.0, **wanted):
    """Cost of a hand that came onto the ball, drew back and closed its fingers."""
    T = np.eye(4)[None]
    T[0, 2, 3] = -0.25
    moved = slide_in(scene_of(), T, np.array([[spread_rad]]), np.array([0.5]), TOUCH_M)
    T[0, 2, 3] += moved[0] - back_off_m
    angles = closed(T, spread_rad)
    poses = T[:, None] @ BARRETT.link_poses(angles)
    ranges = ShapeRanges(**{**dict.fromkeys(ShapeRanges.model_fields, ANY), **wanted})
    return preshape_cost(scene_of(), poses, angles, ranges, SETTINGS)[0]


def test_nothing_asked_nothing_missed():
    assert of(0.0) == 0.0


def test_spread_fingers_push_sideways_and_parallel_ones_do_not():
    assert of(1.05, sideways_share=(0.10, 1.0)) < 0.1
    assert of(0.0, sideways_share=(0.10, 1.0)) > 0.3
    assert of(1.05, sideways_share=(0.0, 0.04)) == 1.0


def test_palm_gap_counts_as_a_share_of_what_is_wanted():
    near, far = (of(0.0, gap, palm_gap_m=(0.2, 1.0)) for gap in (0.0, 0.02))
    assert near - far == pytest.approx(0.02 / 0.2, abs=0.02)


def test_no_measure_counts_more_than_one():
    assert of(0.0, enclosed_diameter_m=(0.0, 1e-6)) == 1.0
