"""A user's mesh is read, mended, or refused in one line that says why."""

import os
from pathlib import Path

import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.objects.mesh_import import import_model
from grasptypes.settings.objects import OwnObject
from grasptypes.settings.roles import PartRole

LIMITS = PARAMS.objects.import_.changed(rebuild_cells=64)


def ball(radius=0.04):
    return trimesh.creation.icosphere(subdivisions=3, radius=radius)


def own(path, unit="m", **keywords):
    return OwnObject(file=str(path), unit=unit, density_kg_m3=1000.0, **keywords)


@pytest.mark.parametrize("suffix", ["stl", "obj", "ply", "glb"])
def test_formats_and_units(tmp_path, suffix):
    path = tmp_path / f"ball.{suffix}"
    ball(40.0).export(path)
    imported = import_model(own(path, "mm", scale=2.0), LIMITS)
    assert imported.model.parts[0].solid.volume() == pytest.approx(ball().volume, rel=1e-3)
    assert imported.scale == 2.0
    assert imported.repairs == ()


def test_named_geometries_become_parts(tmp_path):
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box((0.05,) * 3), node_name="head", geom_name="head")
    scene.add_geometry(
        trimesh.creation.box((0.01, 0.01, 0.1)), node_name="handle", geom_name="handle"
    )
    scene.export(tmp_path / "tool.glb")
    parts = import_model(own(tmp_path / "tool.glb"), LIMITS).model.parts
    assert {part.name for part in parts} == {"head", "handle"}
    roles = {"handle": PartRole(role="handle")}
    parts = import_model(own(tmp_path / "tool.glb", parts=roles), LIMITS).model.parts
    assert {part.name: part.role for part in parts} == {"head": None, **roles}
    with pytest.raises(InputError, match=r"has no part 'grip'; its parts: handle, head"):
        import_model(own(tmp_path / "tool.glb", parts={"grip": roles["handle"]}), LIMITS)


def test_holes_are_closed_and_it_says_so(tmp_path):
    mesh = ball()
    trimesh.Trimesh(mesh.vertices, mesh.faces[12:]).export(tmp_path / "holed.stl")
    imported = import_model(own(tmp_path / "holed.stl"), LIMITS)
    assert imported.model.parts[0].solid.volume() == pytest.approx(mesh.volume, rel=0.01)
    assert "closed holes" in " ".join(imported.repairs)


def test_inside_out_is_turned(tmp_path):
    mesh = ball()
    trimesh.Trimesh(mesh.vertices, mesh.faces[:, ::-1]).export(tmp_path / "turned.ply")
    imported = import_model(own(tmp_path / "turned.ply"), LIMITS)
    assert imported.model.parts[0].solid.volume() == pytest.approx(mesh.volume)
    assert imported.repairs == ("turned faces outwards",)


def split_edge(faces, middle):
    """Faces with a vertex in the middle of the first one's edge, where a face has no area."""
    a, b, c = faces[0]
    return np.vstack([faces[1:], [[a, middle, c], [middle, b, c], [a, b, middle]]])


def test_a_face_without_area_that_closes_a_seam_stays(tmp_path):
    mesh = ball()
    middle = mesh.vertices[mesh.faces[0, :2]].mean(axis=0)
    faces = split_edge(mesh.faces, len(mesh.vertices))
    seamed = trimesh.Trimesh(np.vstack([mesh.vertices, middle]), faces, process=False)
    seamed.export(tmp_path / "seam.ply")
    imported = import_model(own(tmp_path / "seam.ply"), LIMITS)
    assert imported.repairs == ()
    assert imported.model.parts[0].solid.volume() == pytest.approx(mesh.volume)


def test_faces_that_are_there_twice_are_dropped(tmp_path):
    mesh = ball()
    trimesh.Trimesh(mesh.vertices, np.vstack([mesh.faces, mesh.faces[:3]]), process=False).export(
        tmp_path / "twice.ply"
    )
    imported = import_model(own(tmp_path / "twice.ply"), LIMITS)
    assert imported.repairs == ("dropped 3 degenerate or double faces",)


@pytest.mark.skipif(
    "GRASPTYPES_REFERENCE_MESHES" not in os.environ, reason="GRASPTYPES_REFERENCE_MESHES not set"
)
@pytest.mark.parametrize("name", ["mug", "mouse", "flashlight", "pan"])
def test_real_scans_come_through(name):
    path = Path(os.environ["GRASPTYPES_REFERENCE_MESHES"]) / f"{name}.stl"
    solid = import_model(own(path), LIMITS.changed(rebuild_cells=128)).model.parts[0].solid
    extent = np.ptp(np.reshape(solid.bounding_box(), (2, 3)), axis=0)
    assert extent == pytest.approx(trimesh.load_mesh(path).extents, abs=0.003)
    assert solid.volume() == pytest.approx(trimesh.load_mesh(path).volume, rel=0.1)
