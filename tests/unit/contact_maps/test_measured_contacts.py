"""Measured maps of simple bodies: sessions must lie where the body was made warm."""

from dataclasses import fields

import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.contact_map import ContactMap, MapTask, sample_surface
from grasptypes.contact_maps.contact_map_files import read_contact_map, write_contact_map
from grasptypes.contact_maps.measured_contacts import (
    map_measured_contacts,
    read_probability,
    sigmoid,
)
from grasptypes.errors import InputError
from grasptypes.objects.object_files import Surface
from grasptypes.settings.contact_maps import HandProportions

SETTINGS = PARAMS.contact_maps.changed(sessions=4)
RADIUS_M, HEIGHT_M = 0.03, 0.30


@pytest.fixture(scope="module")
def bottle():
    mesh = trimesh.creation.cylinder(RADIUS_M, HEIGHT_M, sections=64)
    return trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(mesh.vertices, mesh.faces, 0.004))


@pytest.fixture(scope="module")
def points(bottle):
    part = np.zeros(len(bottle.vertices), np.int16)
    return sample_surface(Surface(bottle.vertices, bottle.faces, part, ["body"]), 2500, 1)


def task(points, settings=SETTINGS, seed=0, scale=1.0):
    return MapTask(points, ["body"], ("bottle", "use"), seed, scale, settings)


def scan_file(path, mesh, red):
    """A PLY as ContactDB publishes them: coordinates, normals and colours a vertex."""
    scan = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    red = np.broadcast_to(red, len(scan.vertices))
    scan.visual.vertex_colors = np.column_stack([red, 0 * red, 0 * red]).astype(np.uint8)
    scan.export(path, vertex_normal=True)
    return path


def girdle(mesh):
    """Warm all around from 30 to 120 mm above the middle."""
    return np.where(np.abs(mesh.vertices[:, 2] - 0.075) < 0.045, 250, 20)


def spots(mesh):
    """Two warm spots on opposite sides, a fingertip wide."""
    sides = RADIUS_M * np.array([[1, 0, 0], [-1, 0, 0]])
    distance = np.linalg.norm(mesh.vertices[:, None] - sides, axis=2).min(axis=1)
    return np.where(distance < 0.013, 250, 20)


def drawn(path, points, settings=SETTINGS, seed=0):
    asked = task(points, settings, seed)
    return map_measured_contacts(asked, read_probability(path, 1.0, asked), path)


def test_sigmoid_takes_the_ends_to_the_given_values_and_keeps_the_unseen():
    values = sigmoid(np.array([0.2, 0.5, 0.8, np.nan]), 0.05, 0.95)
    assert values[:3] == pytest.approx([0.05, 0.5, 0.95])
    assert np.isnan(values[3])


def test_probability_follows_the_nearest_vertex_and_the_unseen_is_zero(bottle, points, tmp_path):
    red = np.where(bottle.vertices[:, 2] < -0.1, 0, girdle(bottle))
    path = scan_file(tmp_path / "map.ply", bottle, red)
    probability = read_probability(path, 1.0, task(points))
    z_m = points.points_m[:, 2]
    assert probability[np.abs(z_m - 0.075) < 0.04] == pytest.approx(0.95)
    assert probability[(z_m > -0.09) & (z_m < 0.02)] == pytest.approx(0.05)
    assert (probability[z_m < -0.11] == 0).all()


def test_unit_and_scale_place_the_scan(bottle, points, tmp_path):
    small = trimesh.Trimesh(bottle.vertices * 500.0, bottle.faces, process=False)
    path = scan_file(tmp_path / "map.ply", small, girdle(bottle))
    scaled = read_probability(path, 0.001, task(points, scale=2.0))
    path = scan_file(tmp_path / "whole.ply", bottle, girdle(bottle))
    assert np.array_equal(scaled, read_probability(path, 1.0, task(points)))


def test_warm_girdle_is_wrapped_where_it_is_warm(bottle, points, tmp_path):
    contact_map = drawn(scan_file(tmp_path / "map.ply", bottle, girdle(bottle)), points)
    assert (contact_map.style == "power").sum() >= 3
    assert contact_map.centre_m[:, 2] == pytest.approx(0.075, abs=0.05)
    touched = contact_map.sessions >= SETTINGS.threshold
    warm = contact_map.probability >= SETTINGS.threshold
    assert (touched & warm).sum() > 0.7 * touched.sum()
    assert touched[:, warm].mean() > 0.35


def test_warm_spots_are_held_with_fingertips(bottle, points, tmp_path):
    contact_map = drawn(scan_file(tmp_path / "map.ply", bottle, spots(bottle)), points)
    assert (contact_map.style == "precision").sum() >= 3
    assert np.abs(contact_map.centre_m) == pytest.approx(0.0, abs=0.03)


def test_arrays_are_those_of_every_map_and_come_back_the_same(bottle, points, tmp_path):
    path = scan_file(tmp_path / "map.ply", bottle, girdle(bottle))
    contact_map = drawn(path, points, SETTINGS.changed(sessions=2))
    more = drawn(path, points, SETTINGS.changed(sessions=3))
    assert np.array_equal(contact_map.sessions, more.sessions[:2])
    other = drawn(path, points, SETTINGS.changed(sessions=2), seed=1)
    assert not np.array_equal(contact_map.sessions, other.sessions)
    write_contact_map(contact_map, tmp_path / "map.npz")
    back = read_contact_map(tmp_path / "map.npz")
    for field in fields(ContactMap):
        assert np.array_equal(getattr(back, field.name), getattr(contact_map, field.name))
    assert back.sessions.shape == (2, len(points.points_m))


def test_what_no_hand_can_hold_is_refused_in_one_line(bottle, points, tmp_path):
    path = scan_file(tmp_path / "map.ply", bottle, girdle(bottle))
    proportions = dict.fromkeys(HandProportions.model_fields, 1e-4)
    tiny = SETTINGS.changed(hand=HandProportions(**proportions))
    with pytest.raises(InputError, match=r"map\.ply: no hand can hold bottle"):
        drawn(path, points, tiny)
