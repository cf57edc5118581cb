"""The hand is rigid links on joints: whatever the angles, lengths stay and nothing jumps."""

import numpy as np
from examples_of import hands, numbers, within
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.barrett import BARRETT, BASE_M, DISTAL_M, KNUCKLE_M, PROXIMAL_M

from grasptypes.labels.grasp_type import enclosed_diameters

# No fingertip is farther from any joint's axis: base offset, knuckle, both links.
REACH_M = BASE_M + KNUCKLE_M + PROXIMAL_M + DISTAL_M


@given(hands(4))
def test_links_stay_rigid_and_as_long_as_they_are(angles_rad):
    T = BARRETT.link_poses(angles_rad)
    turned = T[..., :3, :3]
    unity = np.broadcast_to(np.eye(3), turned.shape)
    np.testing.assert_allclose(turned @ np.swapaxes(turned, -1, -2), unity, atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(turned), 1.0, atol=1e-12)
    proximal, distal = T[:, 3:6, :3, 3], T[:, 6:9, :3, 3]
    lengths = np.linalg.norm(distal - proximal, axis=-1)
    np.testing.assert_allclose(lengths, PROXIMAL_M, atol=1e-12)


@given(hands(4), numbers(-0.05, 0.05, (4, 8)))
def test_fingertips_move_no_faster_than_their_reach(angles_rad, change_rad):
    moved = BARRETT.fingertips(angles_rad + change_rad) - BARRETT.fingertips(angles_rad)
    limit = REACH_M * np.abs(change_rad).sum(axis=1)
    assert (np.linalg.norm(moved, axis=-1) <= limit[:, None] + 1e-12).all()


@given(hands(3))
def test_a_batch_is_its_single_poses(angles_rad):
    together = BARRETT.link_poses(angles_rad)
    for one, angles in zip(together, angles_rad, strict=True):
        np.testing.assert_allclose(one, BARRETT.link_poses(angles), atol=1e-15)


@given(hands())
def test_fingers_1_and_2_are_mirror_images(angles_rad):
    angles = angles_rad.copy()
    angles[:, 1], angles[:, 3], angles[:, 6] = angles[:, 0], angles[:, 2], angles[:, 5]
    first, second, third = BARRETT.fingertips(angles)[0]
    np.testing.assert_allclose(first, second * [-1, 1, 1], atol=1e-12)
    assert abs(third[0]) < 1e-12


@given(within(BARRETT.dof_limits, 5))
def test_coupled_hands_within_their_limits_have_joints_within_theirs(dofs_rad):
    joints = BARRETT.couple(dofs_rad)
    assert not BARRETT.beyond_limits(joints, 1e-9).any()
    np.testing.assert_array_equal(joints[:, 0], joints[:, 1])
    np.testing.assert_allclose(joints[:, 5:] * 3, joints[:, 2:5], rtol=1e-15)


@given(
    hands(),
    st.integers(0, 7),
    st.floats(1e-6, 1.0),
    st.booleans(),
    st.floats(0.0, 0.1),
)
def test_an_angle_beyond_a_limit_by_more_than_the_tolerance_is_found(
    angles_rad, joint, excess_rad, above, tolerance_rad
):
    low, high = BARRETT.joint_limits[joint]
    by = tolerance_rad + excess_rad
    angles_rad[0, joint] = high + by if above else low - by
    beyond = BARRETT.beyond_limits(angles_rad, tolerance_rad)
    assert beyond[0].tolist() == [index == joint for index in range(8)]


@given(hands(5), st.floats(0.01, 0.5))
def test_a_finger_that_closes_encloses_less(angles_rad, more_rad):
    closed = angles_rad.copy()
    closed[:, 2:5] += more_rad
    assert (enclosed_diameters(BARRETT, closed) <= enclosed_diameters(BARRETT, angles_rad)).all()
