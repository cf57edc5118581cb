"""Poses form a group; a distance grid is what it stands for."""

import numpy as np
import pytest
import trimesh
from examples_of import numbers, poses
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import RigidTransform

from grasptypes.exchange.records import from_position_quaternion, to_position_quaternion
from grasptypes.hands import configuration
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.poses import inverse

RADIUS_M, SPACING_M, MARGIN_M = 0.03, 0.004, 0.02
BALL = trimesh.creation.icosphere(4, RADIUS_M)
GRID = DistanceGrid.from_mesh(BALL.vertices, BALL.faces, SPACING_M, MARGIN_M)
# Of the facets, and of interpolating a distance that bends within a cell.
ERROR_M = 0.001


@given(poses(3), poses(3))
def test_inverses_undo_and_turn_the_order_around(A, B):
    np.testing.assert_allclose(A @ inverse(A), np.broadcast_to(np.eye(4), A.shape), atol=1e-12)
    np.testing.assert_allclose(inverse(inverse(A)), A, atol=1e-12)
    np.testing.assert_allclose(inverse(A @ B), inverse(B) @ inverse(A), atol=1e-12)
    np.testing.assert_array_equal(inverse(A)[1], inverse(A[1]))


@given(poses(2))
def test_poses_come_back_from_quaternions(T):
    numbers = to_position_quaternion(RigidTransform(T, normalize=False))
    assert (numbers[:, 3] >= 0).all()
    np.testing.assert_allclose(from_position_quaternion(numbers).as_matrix(), T, atol=1e-9)


@given(poses(2), numbers(-3, 3, (2, 4)), st.integers(0, 99))
def test_hand_configurations_come_back(T, dofs, rank):
    back = configuration.unpack(configuration.pack(rank, T, dofs))
    np.testing.assert_array_equal(back.T_object_hand, T)
    np.testing.assert_array_equal(back.dofs, dofs)
    assert (back.rank_index == rank).all()


@given(numbers(-0.049, 0.049, (50, 3)))
def test_grid_distances_are_those_of_a_ball(points_m):
    exact = np.linalg.norm(points_m, axis=1) - RADIUS_M
    apart = exact > 2 * SPACING_M - RADIUS_M  # not in its middle, where the distance has a tip
    np.testing.assert_allclose(GRID.distance(points_m)[apart], exact[apart], atol=ERROR_M)


@given(numbers(-1.0, 1.0, (50, 3)))
def test_distances_outside_the_grid_are_never_too_short(points_m):
    exact = np.linalg.norm(points_m, axis=1) - RADIUS_M
    found = GRID.distance(points_m)
    half_m = RADIUS_M + MARGIN_M
    assert (found >= exact - ERROR_M).all()
    assert (found <= exact + 2 * np.sqrt(3) * half_m).all()
    outside_m = np.linalg.norm(np.maximum(np.abs(points_m) - half_m, 0), axis=1)
    assert (found[outside_m > 0] > outside_m[outside_m > 0]).all()


@given(numbers(-0.049, 0.049, (20, 3)), numbers(-1, 1, (20, 3)))
def test_gradients_are_those_of_the_distances(points_m, directions):
    step_m = 1e-7
    ahead, behind = (GRID.distance(points_m + sign * step_m * directions) for sign in (1, -1))
    cells = (points_m - GRID.origin_m) / SPACING_M
    inside = (np.abs(cells - np.round(cells)) > 1e-3).all(axis=1)  # not on an edge of a cell
    gradient = GRID.distance_and_gradient(points_m)[1]
    slope = (gradient * directions).sum(axis=1)
    np.testing.assert_allclose((ahead - behind)[inside] / 2 / step_m, slope[inside], atol=1e-4)


@given(numbers(-0.2, 0.2, 3), numbers(-0.045, 0.045, (10, 3)))
def test_a_grid_moves_with_its_mesh(shift_m, points_m):
    moved = DistanceGrid(GRID.values, GRID.origin_m + shift_m, SPACING_M)
    found = moved.distance(points_m + shift_m)
    assert found == pytest.approx(GRID.distance(points_m), abs=1e-12)
