"""Descriptors: the same however an object lies, and what they measure on simple bodies."""

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation
from tests.unit.settings import PARAMS

from grasptypes.kinds.modelling import build_shape
from grasptypes.segmentation.descriptors import Cloud, describe_points
from grasptypes.segmentation.samples import sample_evenly, sample_roles

SETTINGS = PARAMS.segmentation.descriptors
# Columns after the three extents: the radii of the balls inside and outside.
INSIDE, OUTSIDE = 3, 4


def described(points_m, normals):
    cloud = Cloud.of_points(points_m, normals, SETTINGS.points)
    return describe_points(cloud, points_m[:50], normals[:50], SETTINGS)


def surface(mesh):
    points_m, face = sample_evenly(mesh, SETTINGS.points, "test")
    return points_m, mesh.face_normals[face]


def test_they_do_not_depend_on_where_the_object_lies():
    points_m, normals, _ = sample_roles(build_shape("claw_hammer_s01"), "hammer", SETTINGS.points)
    turn = Rotation.from_euler("xyz", [0.3, -1.1, 2.0]).as_matrix()
    moved = described(points_m @ turn.T + [0.3, -0.2, 1.0], normals @ turn.T)
    # But for points on the border between two bins.
    assert (np.abs(moved - described(points_m, normals)) > 1e-3).mean() < 0.02


@pytest.mark.parametrize("radius_m", [0.01, 0.03])
def test_the_ball_inside_a_sphere_is_the_sphere(radius_m):
    found = described(*surface(trimesh.creation.icosphere(4, radius_m)))
    # Facets make it a little smaller.
    assert np.exp(np.median(found[:, INSIDE])) == pytest.approx(radius_m, rel=0.2)
    # Nothing is outside: as large as the object.
    assert np.exp(found[:, OUTSIDE]) == pytest.approx(2 * radius_m, rel=0.05)


def test_a_hollow_holds_a_ball_outside_the_surface():
    tube = trimesh.creation.annulus(0.03, 0.035, 0.1)
    points_m, normals = surface(tube)
    found = described(points_m, normals)
    inner = (normals[:50] * points_m[:50])[:, :2].sum(axis=1) < -0.02
    assert inner.any()
    assert np.exp(np.median(found[inner, OUTSIDE])) == pytest.approx(0.03, rel=0.3)
    assert np.exp(np.median(found[~inner, OUTSIDE])) > 0.06


def test_there_are_as_many_points_as_asked_for():
    flat = trimesh.creation.box((0.1, 0.1, 0.0001))
    points_m, face = sample_evenly(flat, 700, "flat")
    assert points_m.shape == (700, 3)
    assert face.shape == (700,)
