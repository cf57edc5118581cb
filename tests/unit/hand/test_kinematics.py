"""The hand's forward kinematics against figures stated for GraspIt!'s `Barrett` model."""

import numpy as np
import pytest

from grasptypes.hand import kinematics

TENTH_MM = 1e-4


def tips_m(*dofs_deg: float) -> np.ndarray:
    return kinematics.fingertips(kinematics.couple(np.radians(dofs_deg)))


def test_fingertips_of_the_open_hand_are_where_stated() -> None:
    expected = [[0.025, 0.1586, 0.044], [-0.025, 0.1586, 0.044], [0, -0.1586, 0.044]]
    np.testing.assert_allclose(tips_m(0, 0, 0, 0), expected, atol=TENTH_MM)


def test_fingertips_at_sixty_degrees_are_where_stated() -> None:
    tips = tips_m(0, 60, 60, 60)
    np.testing.assert_allclose(tips[:, 2], 0.1075, atol=TENTH_MM)
    np.testing.assert_allclose(tips[:, 1], [0.048, 0.048, -0.048], atol=TENTH_MM)


def test_spread_of_half_a_turn_brings_all_fingers_to_one_side() -> None:
    tips = tips_m(180, 30, 30, 30)
    np.testing.assert_allclose(tips[:, 1], tips[2, 1], atol=TENTH_MM)
    np.testing.assert_allclose(tips[:, 0], [0.025, -0.025, 0.0], atol=TENTH_MM)


def test_spread_turns_fingers_outwards_and_mirrored() -> None:
    tips = tips_m(90, 0, 0, 0)
    assert tips[0, 0] > 0.15
    np.testing.assert_allclose(tips[0] * [-1, 1, 1], tips[1], atol=1e-12)


@pytest.mark.parametrize("joint", range(8))
def test_link_z_axis_is_the_axis_of_its_joint(joint: int) -> None:
    angles = np.radians([40, 40, 60, 50, 70, 20, 25, 30.0])
    step = np.zeros(8)
    step[joint] = 1e-6
    link = joint + 1
    pose = kinematics.link_poses(angles)[link]
    moved = kinematics.link_poses(angles + step)[link]
    turn = (moved[:3, :3] - pose[:3, :3]) / 1e-6 @ pose[:3, :3].T
    rate = np.array([turn[2, 1], turn[0, 2], turn[1, 0]])
    np.testing.assert_allclose(rate, pose[:3, 2], atol=1e-5)
    np.testing.assert_allclose(moved[:3, 3], pose[:3, 3], atol=1e-15)


def test_a_tip_lags_by_what_is_missing_to_a_third_of_its_finger() -> None:
    angles = kinematics.couple(np.radians([[10.0, 60.0, 90.0, 120.0]]))
    np.testing.assert_allclose(kinematics.lag(angles), 0.0, atol=1e-12)
    angles[0, 5:] += np.radians([5.0, 0.0, -2.0])
    np.testing.assert_allclose(np.degrees(kinematics.lag(angles)), [[-5.0, 0.0, 2.0]], atol=1e-9)
