"""Motors close until they take their torque, and stay within the joints' limits."""

import numpy as np
from synthesis_cases import PARAMS

from grasptypes.hand import kinematics
from grasptypes.synthesis.holding import Motors, PhysicsSettings

SETTINGS = PhysicsSettings(**PARAMS["physics"]["test"])
ANGLES = kinematics.couple(np.radians([30.0, 60.0, 60.0, 60.0]))


def test_free_motors_close_at_their_speed_and_the_coupling_ratio() -> None:
    speeds, torques = Motors(ANGLES, SETTINGS).drive(ANGLES)
    third = kinematics.DISTAL_RATIO
    expected = SETTINGS.closing_speed_rad_s * np.array([0, 0, 1, 1, 1, third, third, third])
    np.testing.assert_allclose(speeds, expected)
    tip = SETTINGS.fingertip_force_n * kinematics.DISTAL_LENGTH_M
    np.testing.assert_allclose(torques[5:], tip)
    assert np.all(torques[2:5] > torques[5:])


def test_a_joint_that_is_driven_back_withstands_the_passive_force() -> None:
    motors = Motors(ANGLES, SETTINGS)
    motors.drive(ANGLES + 0.2)
    speeds, torques = motors.drive(ANGLES + 0.1)
    assert np.all(speeds[2:] > 0)
    passive = SETTINGS.passive_force_n * kinematics.DISTAL_LENGTH_M
    np.testing.assert_allclose(torques[5:], passive)


def test_spread_returns_to_where_it_was_from_either_side() -> None:
    for shift in (0.1, -0.1):
        speeds, torques = Motors(ANGLES, SETTINGS).drive(ANGLES + shift)
        assert np.all(np.sign(speeds[:2]) == -np.sign(shift))
        assert np.all(torques[:2] > 0)


def test_joints_at_their_limits_stand_still() -> None:
    speeds, _ = Motors(ANGLES, SETTINGS).drive(kinematics.JOINT_LIMITS_RAD[:, 1])
    np.testing.assert_array_equal(speeds[2:], 0.0)
