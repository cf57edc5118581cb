"""Hands stop at the object, and fingers close as the TorqueSwitch makes them."""

import numpy as np
import pytest
from synthesis_cases import CLOSING, RADIUS_M, TOUCH_M, closed, palm_at, scene_of
from tests.unit.barrett import BARRETT, COUPLING

from grasptypes.hands.reading import load_hand
from grasptypes.synthesis.approach import slide_in
from grasptypes.synthesis.closing import close_fingers
from grasptypes.synthesis.energy import closeness
from grasptypes.synthesis.hand_model import hand_model


def gaps(T, angles, scene=None):
    poses = T[:, None] @ BARRETT.link_poses(angles)
    return closeness(scene or scene_of(), poses).gaps_m


def test_palm_slides_up_to_the_ball_and_no_further() -> None:
    moved = slide_in(scene_of(), palm_at(0.25), np.zeros((1, 1)), np.array([0.3]), TOUCH_M)
    assert moved[0] == pytest.approx(0.25 - RADIUS_M, abs=0.002)


def test_hand_goes_its_whole_way_if_nothing_stops_it() -> None:
    moved = slide_in(scene_of(), palm_at(0.25), np.zeros((1, 1)), np.array([0.1]), TOUCH_M)
    assert moved[0] == pytest.approx(0.1)


@pytest.mark.parametrize("spread", [0.0, 0.6, 1.2, 2.0, np.pi])
@pytest.mark.parametrize("height", [0.035, 0.07, 0.1])
def test_every_finger_ends_at_the_ball_or_at_its_limit_without_passing_it(spread, height) -> None:
    T = palm_at(height)
    angles = closed(T, spread)
    assert not BARRETT.beyond_limits(angles, 1e-9).any()
    gap = gaps(T, angles)[0]
    assert gap.min() > -1e-6
    for finger in range(3):
        touches = min(gap[3 + finger], gap[6 + finger]) <= TOUCH_M
        at_limit = angles[0, 5 + finger] >= BARRETT.joint_limits[5, 1] - 1e-6
        assert touches or at_limit


def test_free_fingers_close_to_their_limits() -> None:
    angles = closed(palm_at(5.0), 0.0)[0]
    np.testing.assert_allclose(angles[2:], BARRETT.joint_limits[2:, 1], atol=1e-6)


def test_finger_stopped_at_its_tip_stays_coupled() -> None:
    angles = closed(palm_at(0.11), 0.0)[0]
    np.testing.assert_allclose(angles[5:], angles[2:5] * COUPLING)


def test_finger_stopped_at_its_base_goes_on_with_its_tip() -> None:
    box = scene_of("box")
    T = palm_at(0.026)
    angles = closed(T, 0.0, scene=box)[0]
    lead = angles[5:] - angles[2:5] * COUPLING
    assert np.all(lead > 0.05)
    assert gaps(T, angles[None], box)[0, 3:6].max() <= TOUCH_M


@pytest.mark.parametrize("grip", ["wrap", "enclose", "tripod", "pinch"])
@pytest.mark.parametrize("name", ["allegro", "robotiq_3f"])
def test_free_fingers_end_at_the_palm_or_at_the_fingers_closed_before(name, grip) -> None:
    hand = load_hand(name)
    preshapes = np.array(hand.grips.named(grip).preshapes)
    model = hand_model(hand, 0.006, 0.012, 0.004, 0.02)
    scene = scene_of()._replace(hand=hand, model=model)
    T_object_hand = np.repeat(palm_at(5.0), len(preshapes), axis=0)

    def depth_m(scene):
        hands = close_fingers(scene, T_object_hand, preshapes, CLOSING)
        return closeness(scene, hands.link_poses()).self_depth_m.max()

    assert depth_m(scene) <= CLOSING.self_depth_m
    passing = scene._replace(model=model._replace(ends_at_hand=False))
    if grip == "wrap":
        assert depth_m(passing) > CLOSING.self_depth_m
