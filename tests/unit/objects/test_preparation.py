"""Prepared objects are consistent: watertight surface, named parts, weight, same bytes."""

import io

import numpy as np
import pytest
import trimesh

from grasptypes.kinds.catalogue import build
from grasptypes.objects import object_files, solids
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.parts import ImportedModel, Material, ObjectModel, Part
from grasptypes.objects.preparation import physical_properties, prepare
from grasptypes.settings.objects import Resolution

COARSE = Resolution(
    surface_tolerance_m=1e-4,
    surface_edge_m=0.006,
    crease_deg=40,
    grid_spacing_m=0.004,
    grid_margin_m=0.01,
    collision_max_parts=16,
    collision_max_gap_m=5e-4,
    collision_tolerance_m=4e-4,
    collision_max_vertices=64,
)
RED = Material((1.0, 0.0, 0.0, 1.0))


def dumbbell(**keywords):
    left = Part("left", solids.box((0.02, 0.02, 0.02)).translate((-0.03, 0, 0)), RED)
    bar = Part("bar", solids.box((0.06, 0.004, 0.004)), RED)
    right = Part("right", solids.box((0.02, 0.02, 0.02)).translate((0.03, 0, 0)), RED, **keywords)
    return ObjectModel((left, bar, right), density_kg_m3=1000.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    target = tmp_path_factory.mktemp("mug")
    prepare("mug", ImportedModel(build("mug"), 1.15), COARSE, target)
    return target


def test_surface_is_closed_even_and_named(folder):
    surface = object_files.read_surface(folder / object_files.SURFACE)
    mesh = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(1.15**3 * 181.9e-6, rel=0.02)
    assert np.quantile(mesh.edges_unique_length, 0.99) < 2 * COARSE.surface_edge_m
    assert surface.part_names.tolist() == ["rim", "wall", "base", "handle"]
    assert surface.vertices[surface.part_index == 3, 0].max() == pytest.approx(
        1.15 * 0.0712, abs=1e-3
    )


def test_files_agree_with_each_other(folder):
    surface = object_files.read_surface(folder / object_files.SURFACE)
    grid = DistanceGrid.load(folder / object_files.DISTANCE_GRID)
    lines = (folder / object_files.COLLISION).read_text().splitlines()
    hulls = [[float(x) for x in line.split()[1:]] for line in lines if line.startswith("v ")]
    assert np.abs(grid.distance(surface.vertices)).max() < 2e-3
    assert grid.distance(np.array(hulls)).max() < 2e-3
    properties = object_files.read_properties(folder / object_files.PROPERTIES)
    assert np.array(properties.bounds_m) == pytest.approx(
        np.array([surface.vertices.min(axis=0), surface.vertices.max(axis=0)]), abs=2e-4
    )


def test_visual_keeps_parts_and_colours(folder):
    scene = trimesh.load_scene(
        io.BytesIO((folder / object_files.VISUAL).read_bytes()), file_type="glb"
    )
    assert {name.rsplit("_", 1)[0] for name in scene.geometry} == {"rim", "wall", "base", "handle"}
    handle = next(mesh for name, mesh in scene.geometry.items() if name.startswith("handle"))
    red, green, blue, _ = handle.visual.material.baseColorFactor
    assert red > 2 * max(green, blue)


def test_same_bytes_again(folder, tmp_path):
    prepare("mug", ImportedModel(build("mug"), 1.15), COARSE, tmp_path)
    for path in sorted(folder.iterdir()):
        assert (tmp_path / path.name).read_bytes() == path.read_bytes(), path.name


def test_heavier_part_draws_the_centre_of_mass():
    even = physical_properties("dumbbell", ImportedModel(dumbbell(), 1.0))
    assert even.centre_of_mass_m == pytest.approx([0, 0, 0], abs=1e-9)
    heavy = physical_properties("dumbbell", ImportedModel(dumbbell(density_kg_m3=3000.0), 1.0))
    assert heavy.centre_of_mass_m[0] > 0.01
    # The bar's end that lies in the heavy box is the bar's: earlier parts own what they share.
    assert heavy.mass_kg - even.mass_kg == pytest.approx(
        2000 * (0.02**3 - 0.01 * 0.004**2), rel=1e-6
    )


def test_given_mass_scales_the_inertia():
    own = physical_properties("dumbbell", ImportedModel(dumbbell(), 1.0))
    given = physical_properties("dumbbell", ImportedModel(dumbbell(), 1.0, mass_kg=2 * own.mass_kg))
    assert given.mass_kg == pytest.approx(2 * own.mass_kg)
    assert np.array(given.inertia_kg_m2) == pytest.approx(2 * np.array(own.inertia_kg_m2))
