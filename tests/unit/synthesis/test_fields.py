"""Compiled distances agree with the grid they come from, and never overstate."""

import numpy as np
import trimesh
from synthesis_cases import RADIUS_M, ball, scene_of

from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.synthesis.fields import distance, distances, field_at, fields, gradient


def test_same_as_the_grid_within_its_box() -> None:
    mesh = ball()
    grid = DistanceGrid.from_mesh(mesh.vertices, mesh.faces, 0.002, 0.02)
    points = np.random.default_rng(0).uniform(-0.045, 0.045, (500, 3))
    np.testing.assert_allclose(
        distances(scene_of().field, points), grid.distance(points), atol=1e-9
    )


def test_never_more_than_the_distance_outside_of_the_box() -> None:
    points = np.random.default_rng(0).uniform(-0.4, 0.4, (500, 3))
    exact = np.linalg.norm(points, axis=1) - RADIUS_M
    found = distances(scene_of().field, points)
    assert np.all(found <= exact + 5e-4)
    assert np.all(found[exact > 0.05] > 0.6 * exact[exact > 0.05])


def test_gradient_points_away_from_the_object() -> None:
    point = np.array([0.02, -0.01, 0.02])
    assert np.dot(gradient(scene_of().field, *point), point / np.linalg.norm(point)) > 0.999


def test_packed_grids_keep_their_own_distances() -> None:
    box = box_grid()
    ball_again = DistanceGrid.from_mesh(ball().vertices, ball().faces, 0.002, 0.02)
    packed = fields([box, ball_again])
    for index, grid in enumerate((box, ball_again)):
        np.testing.assert_allclose(
            distance(field_at(packed, index), 0.01, 0.02, -0.03),
            grid.distance([0.01, 0.02, -0.03]),
        )


def box_grid() -> DistanceGrid:
    mesh = trimesh.creation.box((0.02, 0.04, 0.06))
    return DistanceGrid.from_mesh(mesh.vertices, mesh.faces, 0.002, 0.02)
