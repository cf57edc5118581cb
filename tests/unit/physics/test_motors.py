"""Motors close with the grip force, and withstand being driven back from where they were."""

import numpy as np
import pytest
from tests.unit.barrett import BARRETT, COUPLING, DISTAL_M
from tests.unit.settings import PARAMS

from grasptypes.hands.reading import load_hand
from grasptypes.physics.motors import Motors, grip_forces

SETTINGS = PARAMS.physics.test
MOTORS = BARRETT.motors
FORCE_N = MOTORS.fingertip_force_n
ANGLES = BARRETT.couple(np.radians([30.0, 60.0, 60.0, 60.0]))


def motors_at(positions=ANGLES, forces_n=(FORCE_N,) * 3) -> Motors:
    return Motors(BARRETT, positions, np.array(forces_n))


def released(finger: int) -> Motors:
    motors = motors_at()
    motors.stop(finger, 1)
    return motors


def test_one_motor_closes_base_and_tip_at_the_coupling_ratio() -> None:
    command = motors_at().drive(ANGLES)
    third = COUPLING
    expected = MOTORS.closing_speed_rad_s * np.array([0, 0, 1, 1, 1, third, third, third])
    np.testing.assert_allclose(command.speeds, expected)
    np.testing.assert_array_equal(command.closing_torques[5:], 0.0)
    step = 1e-6 * BARRETT.couple([0.0, 1.0, 1.0, 1.0])
    way = BARRETT.fingertips(ANGLES + step) - BARRETT.fingertips(ANGLES)
    lever = np.linalg.norm(way, axis=1) / 1e-6
    np.testing.assert_allclose(command.closing_torques[2:5], FORCE_N * lever, rtol=1e-4)


def test_the_tip_of_a_released_finger_goes_on_alone() -> None:
    command = released(1).drive(ANGLES)
    assert command.speeds[3] == command.closing_torques[3] == 0.0
    assert command.speeds[6] == MOTORS.closing_speed_rad_s * (1 + COUPLING)
    np.testing.assert_allclose(command.closing_torques[6], FORCE_N * DISTAL_M)
    assert command.passive_torques[3] > 4 * FORCE_N * DISTAL_M  # withstands
    assert command.passive_torques[5] == command.passive_torques[7] == 0.0


def test_a_finger_planned_with_its_tip_ahead_is_released() -> None:
    ahead = ANGLES.copy()
    ahead[7] += 0.1
    assert motors_at(ahead).stages == [0, 0, 1]


def test_a_joint_withstands_being_driven_back_from_where_it_has_been() -> None:
    motors = released(0)
    motors.drive(ANGLES + 0.2)
    command = motors.drive(ANGLES + 0.1)
    np.testing.assert_allclose(command.reached[3:6], (ANGLES + 0.2)[3:6])
    np.testing.assert_allclose(command.passive_torques[5], MOTORS.passive_force_n * DISTAL_M)


def test_what_does_not_close_keeps_its_place_when_pushed_either_way() -> None:
    for shift in (0.1, -0.1):
        motors = released(1)
        command = motors.drive(ANGLES + shift)
        stays = [0, 1, 3]
        np.testing.assert_array_equal(command.reached[stays], ANGLES[stays])
        np.testing.assert_array_equal(command.closing_torques[stays], 0.0)
        assert np.all(command.passive_torques[stays] > 0.0)


def test_no_joint_is_held_beyond_its_limit() -> None:
    command = motors_at().drive(BARRETT.joint_limits[:, 1] + 0.1)
    assert np.all(command.reached <= BARRETT.joint_limits[:, 1])


def test_the_grip_force_follows_the_weight_within_what_the_hand_can() -> None:
    light, middle, heavy = (grip_forces(BARRETT, mass, SETTINGS) for mass in (0.01, 0.3, 5.0))
    np.testing.assert_array_equal(light, MOTORS.fingertip_force_n)
    np.testing.assert_allclose(middle, SETTINGS.grip_weights * 0.3 * SETTINGS.gravity_m_s2)
    assert heavy[2] == MOTORS.rated_force_n
    stronger = motors_at(forces_n=middle).drive(ANGLES).closing_torques
    gentle = motors_at().drive(ANGLES).closing_torques
    np.testing.assert_allclose(stronger, middle[0] / FORCE_N * gentle)


@pytest.mark.parametrize("name", ["barrett", "robotiq_3f", "allegro", "franka_hand"])
def test_fingers_never_push_the_thumb_back(name) -> None:
    hand = load_hand(name)
    forces = grip_forces(hand, 5.0, SETTINGS)
    thumbs = np.array([finger.thumb for finger in hand.fingers])
    assert forces[~thumbs].sum() < hand.motors.passive_force_n * thumbs.sum()
