"""The closing motion begins open, ends in the grasp, and never opens a finger."""

import numpy as np
import pytest

from grasptypes.hands.folders import hand_names
from grasptypes.hands.reading import load_hand
from grasptypes.viewer.closing_motion import RETREAT_M, closing_motion


@pytest.mark.parametrize("name", hand_names())
def test_it_begins_open_and_ends_in_the_grasp(name: str) -> None:
    hand = load_hand(name)
    dofs = hand.dof_limits.mean(axis=1)
    goal = hand.couple(dofs)
    motion = closing_motion(hand, goal)
    np.testing.assert_allclose(motion.positions[0], hand.opened(hand.preshape_of(goal)))
    np.testing.assert_array_equal(motion.positions[-1], goal)
    assert motion.retreat_m[0] == RETREAT_M
    assert not motion.retreat_m[1:].any()
    assert len(motion.positions) == len(motion.retreat_m)


def test_the_tip_goes_on_when_the_object_stops_the_base() -> None:
    hand = load_hand("barrett")
    goal = hand.couple([0.0, 1.0, 1.0, 1.0])
    finger = hand.fingers[0]
    goal[finger.joints[1]] += 0.4
    motion = closing_motion(hand, goal)
    base, tip = (motion.positions[1:, joint] for joint in finger.joints)
    np.testing.assert_allclose(base, [finger.open[0], 1.0, 1.0])
    assert tip[0] < tip[1] < tip[2] == goal[finger.joints[1]]
    assert tip[2] - tip[1] == pytest.approx(0.4)
