"""Motors close until they take their torque, and stay within the joints' limits."""

import numpy as np
from tests.unit.barrett import BARRETT, COUPLING, DISTAL_M
from tests.unit.settings import PARAMS

from grasptypes.physics.motors import Motors

SETTINGS = PARAMS.physics.test
MOTORS = BARRETT.motors
ANGLES = BARRETT.couple(np.radians([30.0, 60.0, 60.0, 60.0]))


def released(finger: int) -> Motors:
    motors = Motors(BARRETT, ANGLES, SETTINGS)
    motors.stop(finger, 1)
    return motors


def test_one_motor_closes_base_and_tip_at_the_coupling_ratio() -> None:
    speeds, torques = Motors(BARRETT, ANGLES, SETTINGS).drive(ANGLES)[:2]
    third = COUPLING
    expected = MOTORS.closing_speed_rad_s * np.array([0, 0, 1, 1, 1, third, third, third])
    np.testing.assert_allclose(speeds, expected)
    np.testing.assert_array_equal(torques[5:], 0.0)
    step = 1e-6 * BARRETT.couple([0.0, 1.0, 1.0, 1.0])
    way = BARRETT.fingertips(ANGLES + step) - BARRETT.fingertips(ANGLES)
    lever = np.linalg.norm(way, axis=1) / 1e-6
    np.testing.assert_allclose(torques[2:5], MOTORS.fingertip_force_n * lever, rtol=1e-4)


def test_the_tip_of_a_released_finger_goes_on_alone() -> None:
    speeds, torques = released(1).drive(ANGLES)[:2]
    assert speeds[3] == 0.0
    assert speeds[6] == MOTORS.closing_speed_rad_s * (1 + COUPLING)
    tip = DISTAL_M
    np.testing.assert_allclose(torques[6], MOTORS.fingertip_force_n * tip)
    assert torques[3] > 4 * MOTORS.fingertip_force_n * tip  # withstands
    assert torques[5] == torques[7] == 0.0


def test_a_finger_planned_with_its_tip_ahead_is_released() -> None:
    ahead = ANGLES.copy()
    ahead[7] += 0.1
    assert Motors(BARRETT, ahead, SETTINGS).stages == [0, 0, 1]


def test_a_joint_that_is_driven_back_withstands_the_passive_force() -> None:
    motors = released(0)
    motors.drive(ANGLES + 0.2)
    speeds, torques = motors.drive(ANGLES + 0.1)[:2]
    assert np.all(speeds[3:6] > 0)
    np.testing.assert_allclose(torques[5], MOTORS.passive_force_n * DISTAL_M)
    closing = Motors(BARRETT, ANGLES, SETTINGS).drive(ANGLES).torques
    more = MOTORS.passive_force_n / MOTORS.fingertip_force_n
    np.testing.assert_allclose(torques[3:5], more * closing[3:5])


def test_the_base_of_a_released_finger_keeps_its_place_when_pushed_either_way() -> None:
    for shift in (0.1, -0.1):
        motors = released(1)
        motors.drive(ANGLES + shift)
        speeds, torques = motors.drive(ANGLES + shift)[:2]
        assert np.sign(speeds[3]) == -np.sign(shift)
        assert torques[3] > 4 * MOTORS.fingertip_force_n * DISTAL_M


def test_spread_returns_to_where_it_was_from_either_side() -> None:
    for shift in (0.1, -0.1):
        speeds, torques = Motors(BARRETT, ANGLES, SETTINGS).drive(ANGLES + shift)[:2]
        assert np.all(np.sign(speeds[:2]) == -np.sign(shift))
        assert np.all(torques[:2] > 0)


def test_joints_at_their_limits_stand_still() -> None:
    speeds = Motors(BARRETT, ANGLES, SETTINGS).drive(BARRETT.joint_limits[:, 1]).speeds
    np.testing.assert_array_equal(speeds[2:], 0.0)
