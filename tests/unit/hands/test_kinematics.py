"""The hand's forward kinematics against figures stated for GraspIt!'s `Barrett` model."""

import numpy as np
import pytest
from tests.unit.barrett import BARRETT, COUPLING, DISTAL_M, KNUCKLE_M, LINK, PROXIMAL_M

from grasptypes.hands.states import HandStates

TENTH_MM = 1e-4


def tips_m(*dofs_deg: float) -> np.ndarray:
    return BARRETT.fingertips(BARRETT.couple(np.radians(dofs_deg)))


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
    pose = BARRETT.link_poses(angles)[link]
    moved = BARRETT.link_poses(angles + step)[link]
    turn = (moved[:3, :3] - pose[:3, :3]) / 1e-6 @ pose[:3, :3].T
    rate = np.array([turn[2, 1], turn[0, 2], turn[1, 0]])
    np.testing.assert_allclose(rate, pose[:3, 2], atol=1e-5)
    np.testing.assert_allclose(moved[:3, 3], pose[:3, 3], atol=1e-15)


def test_a_tip_lags_by_what_is_missing_to_a_third_of_its_finger() -> None:
    angles = BARRETT.couple(np.radians([[10.0, 60.0, 90.0, 120.0]]))
    np.testing.assert_allclose(BARRETT.lag(angles), 0.0, atol=1e-12)
    angles[0, 5:] += np.radians([5.0, 0.0, -2.0])
    expected = [[0.0, 0.0, 0.0, 0.0, 0.0, -5.0, 0.0, 2.0]]
    np.testing.assert_allclose(np.degrees(BARRETT.lag(angles)), expected, atol=1e-9)


def test_links_have_the_stated_lengths_and_the_joints_the_stated_ranges() -> None:
    T = BARRETT.link_poses(np.zeros(8))

    def apart(first: str, second: str) -> float:
        return float(np.linalg.norm(T[LINK[first], :3, 3] - T[LINK[second], :3, 3]))

    for finger in BARRETT.fingers:
        number = finger.name[-1]
        assert apart(f"proximal_{number}", f"distal_{number}") == pytest.approx(PROXIMAL_M)
        assert finger.tip_m == pytest.approx([DISTAL_M, 0.0, 0.0])
    for number in (1, 2):
        assert apart(f"knuckle_{number}", f"proximal_{number}") == pytest.approx(KNUCKLE_M)
    assert BARRETT.finger_length_m == pytest.approx(PROXIMAL_M + DISTAL_M)
    ranges_deg = np.degrees(BARRETT.joint_limits)
    np.testing.assert_allclose(ranges_deg[:, 0], 0.0)
    np.testing.assert_allclose(ranges_deg[:, 1], [180, 180, *[140] * 3, *[48] * 3])
    np.testing.assert_allclose(np.degrees(BARRETT.dof_limits), [[0, 180], *[[0, 140]] * 3])


def test_names_are_in_the_order_of_the_module() -> None:
    assert BARRETT.link_names == (
        "palm", "knuckle_1", "knuckle_2", *(f"proximal_{n}" for n in (1, 2, 3)),
        *(f"distal_{n}" for n in (1, 2, 3)),
    )  # fmt: skip
    assert BARRETT.dof_names == ("spread", "finger_1", "finger_2", "finger_3")
    assert [finger.thumb for finger in BARRETT.fingers] == [False, False, True]
    assert BARRETT.tip_links == (6, 7, 8)
    assert BARRETT.finger_links == (3, 4, 5, 6, 7, 8)
    assert BARRETT.path(BARRETT.fingers[1]) == (7, 4, 2)
    assert BARRETT.path(BARRETT.fingers[2]) == (8, 5)


def test_degrees_of_freedom_come_back_from_coupled_joints() -> None:
    dofs = np.random.default_rng(0).uniform(*BARRETT.dof_limits.T, (20, 4))
    positions = BARRETT.couple(dofs)
    np.testing.assert_allclose(BARRETT.dofs_of(positions), dofs)
    np.testing.assert_allclose(positions[:, 5:], COUPLING * positions[:, 2:5])
    np.testing.assert_array_equal(BARRETT.preshaped(dofs[:, :1])[:, :2], dofs[:, [0, 0]])
    np.testing.assert_array_equal(BARRETT.preshaped(dofs[:, :1])[:, 2:], 0.0)


def test_knuckles_apart_count_alike_in_the_spread() -> None:
    positions = np.zeros((1, 8))
    positions[0, :2] = 0.2, 0.4
    np.testing.assert_allclose(BARRETT.preshape_of(positions), [[0.3]])
    state = HandStates(BARRETT, np.eye(4)[None], positions)
    np.testing.assert_allclose(state.preshape, [[0.3]])


def test_states_pose_links_in_the_object_s_frame() -> None:
    T = np.tile(np.eye(4), (3, 1, 1))
    T[:, :3, 3] = np.arange(9).reshape(3, 3)
    positions = BARRETT.couple(np.full((3, 4), 0.5))
    states = HandStates(BARRETT, T, positions)
    some = states.take(np.array([False, True, True]))
    expected = BARRETT.link_poses(positions[0])
    for row, poses in enumerate(some.link_poses(), start=1):
        np.testing.assert_allclose(poses[:, :3, 3], expected[:, :3, 3] + T[row, :3, 3])
        np.testing.assert_allclose(poses[:, :3, :3], expected[:, :3, :3])
