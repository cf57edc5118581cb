"""The distance grid is right in sign, size and direction on shapes with known distances."""

import numpy as np
import pytest
import trimesh

from grasptypes.errors import InputError
from grasptypes.files import write_npz
from grasptypes.objects.distance_grid import DistanceGrid

RADIUS_M = 0.03


@pytest.fixture(scope="module")
def ball():
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=RADIUS_M)
    return DistanceGrid.from_mesh(mesh.vertices, mesh.faces, spacing_m=0.002, margin_m=0.02)


@pytest.fixture(scope="module")
def points():
    generator = np.random.default_rng(0)
    directions = generator.normal(size=(500, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return directions * generator.uniform(0.02, 0.045, size=(500, 1))


def test_distance_to_a_ball(ball, points):
    expected = np.linalg.norm(points, axis=1) - RADIUS_M
    assert ball.distance(points) == pytest.approx(expected, abs=1.5e-4)


def test_gradient_points_away_from_a_ball(ball, points):
    _, gradient = ball.distance_and_gradient(points)
    radial = points / np.linalg.norm(points, axis=1, keepdims=True)
    assert np.einsum("ni,ni->n", gradient, radial).min() > 0.95


def test_gradient_is_the_slope_of_the_interpolant(ball, points):
    _, gradient = ball.distance_and_gradient(points[:50])
    for axis in range(3):
        step = 1e-7 * np.eye(3)[axis]
        slope = (ball.distance(points[:50] + step) - ball.distance(points[:50] - step)) / 2e-7
        # A step across a cell's wall sees two slopes.
        assert np.median(np.abs(slope - gradient[:, axis])) < 1e-6


def test_box_has_flat_distances():
    mesh = trimesh.creation.box((0.04, 0.06, 0.08))
    grid = DistanceGrid.from_mesh(mesh.vertices, mesh.faces, 0.002, 0.01)
    assert grid.distance([[0, 0, 0], [0.025, 0, 0], [0, 0.02, 0]]) == pytest.approx(
        [-0.02, 0.005, -0.01], abs=1e-6
    )


def test_outside_the_grid_the_way_to_its_box_is_added(ball):
    far, gradient = ball.distance_and_gradient([0.5, 0.0, 0.0])
    assert far == pytest.approx(0.5 - RADIUS_M, abs=2e-3)
    assert gradient == pytest.approx([1.0, 0.0, 0.0])


def test_holes_do_not_turn_the_sign():
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=RADIUS_M)
    grid = DistanceGrid.from_mesh(mesh.vertices, mesh.faces[20:], 0.003, 0.01)
    assert grid.distance([0.015, 0.0, 0.0]) == pytest.approx(-0.015, abs=1e-3)
    assert grid.distance([0.0, 0.0, 0.038]) > 0


def test_file_round_trip_keeps_bytes(ball, tmp_path):
    ball.save(tmp_path / "a.npz")
    DistanceGrid.load(tmp_path / "a.npz").save(tmp_path / "b.npz")
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_other_files_are_refused(tmp_path):
    write_npz(tmp_path / "x.npz", {"values": np.zeros(3)})
    with pytest.raises(InputError, match="origin_m"):
        DistanceGrid.load(tmp_path / "x.npz")
