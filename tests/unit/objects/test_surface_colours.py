"""Colours of a user's mesh: read from every format, and shown on the surface made from it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image
from tests.unit.objects.mesh_texts import BRACKET, binary_stl, obj, triangles
from tests.unit.settings import PARAMS
from trimesh.visual.material import PBRMaterial

from grasptypes.objects.mesh_companions import companions
from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.parts import ImportedModel, Material
from grasptypes.objects.preparation import part_surface, scaled_parts, visual_glb
from grasptypes.objects.surface_colours import GREY, encoded
from grasptypes.renders.scene import load_parts
from grasptypes.settings.objects import OwnObject

LIMITS = PARAMS.objects.import_.changed(colour_cells=40)
V, T = BRACKET.vertices, np.array(triangles())
RED, GREEN, BLUE, WHITE = (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)
# Lower left, lower right, upper left and upper right quarter of a texture.
QUARTERS = (RED, GREEN, BLUE, WHITE)
# The colour of each vertex, and that of each corner of an unjoined mesh.
SHADES = np.round((V - V.min(axis=0)) / np.ptp(V, axis=0) * 255).astype(np.uint8)
SPLIT = trimesh.Trimesh(V[T].reshape(-1, 3), np.arange(T.size).reshape(-1, 3), process=False)


def imported(path: Path) -> ImportedModel:
    return import_model(OwnObject(file=str(path), unit="m", density_kg_m3=1.0), LIMITS)


def colours_of(found: ImportedModel, points: np.ndarray) -> np.ndarray:
    """sRGB colours of the visible surface at points."""
    assert found.model.colours is not None
    return encoded(found.model.colours.at(points)[1])


def write_texture(path: Path) -> None:
    pixels = np.array([QUARTERS[2:], QUARTERS[:2]]) * 255
    Image.fromarray(pixels.astype(np.uint8)).resize((8, 8), Image.Resampling.NEAREST).save(path)


def two_materials(folder: Path, mtl: str | None) -> ImportedModel:
    """The bracket, half of whose faces have the material `a`, the others `b b`."""
    if mtl is not None:
        (folder / "a.mtl").write_text(mtl)
    halves = "usemtl a\n" + obj(V, T[:14]) + "usemtl b b\n" + obj(V[:0], T[14:])
    (folder / "a.obj").write_text("mtllib a.mtl\n" + halves)
    return imported(folder / "a.obj")


def test_materials_of_an_obj(tmp_path):
    found = two_materials(tmp_path, "newmtl a\nKd 1 0.5 0\nnewmtl b b\nKd 0.2\n")
    assert found.repairs == ()
    shown = colours_of(found, V[T].mean(axis=1))
    np.testing.assert_allclose(shown, [[1, 0.5, 0]] * 14 + [[0.2] * 3] * (len(T) - 14), atol=1e-9)


@pytest.mark.parametrize(
    ("mtl", "repair"),
    [
        (None, "material 'a', 'b b' are grey: no such file: a.mtl"),
        ("newmtl a\nKd 1 0 0\n", "material 'b b' are grey: no material file defines it"),
        (
            "newmtl a\nKd 1 0 0\nnewmtl b b\nKd 255 0 0\n",
            "material 'b b' are grey: a.mtl: line 4: 'kd 255 0 0' needs numbers from 0 to 1",
        ),
    ],
)
def test_missing_materials_are_grey_and_mentioned(tmp_path, caplog, mtl, repair):
    found = two_materials(tmp_path, mtl)
    assert found.repairs == (f"faces of the {repair}",)
    assert caplog.messages == [f"{tmp_path / 'a.obj'}: faces of the {repair}"]
    if mtl is None:
        assert found.model.parts[0].material == GREY
    else:
        grey = colours_of(found, V[T[14:]].mean(axis=1))
        np.testing.assert_allclose(grey, [GREY.base_color[:3]] * len(grey))


@pytest.mark.parametrize(
    ("statements", "material"),
    [
        ("Kd 1 0 0", Material((1, 0, 0, 1))),
        ("Kd 1 0 0\nd 0.25", Material((1, 0, 0, 0.25))),
        ("Kd 1 0 0\nd 1\nTr 0.75", Material((1, 0, 0, 0.25))),
        ("Kd 1 0 0\nNs 198\nKs 0 0 0", Material((1, 0, 0, 1))),
        ("Kd 1 0 0\nNs 198\nKs 1 1 1", Material((1, 0, 0, 1), roughness=0.01**0.25)),
        ("Kd 1 0 0\nNs 198\nKs 1 1 1\nPr 0.3\nPm 1", Material((1, 0, 0, 1), 1, 0.3)),
    ],
)
def test_statements_of_an_mtl(tmp_path, statements, material):
    found = two_materials(tmp_path, f"newmtl a\n{statements}\nnewmtl b b\n{statements}\n")
    assert found.model.colours is None
    assert found.model.parts[0].material == material


def textured(path: Path, name: str, statement: str) -> ImportedModel:
    """The bracket with a texture across its x and y."""
    write_texture(path / name)
    (path / "a.mtl").write_text(f"newmtl a\nKd 1 1 1\n{statement}\n")
    places = "".join(f"vt {u} {v}\n" for u, v in (V[:, :2] / (0.06, 0.05)).tolist())
    faces = "".join("f " + " ".join(f"{k + 1}/{k + 1}" for k in face) + "\n" for face in T)
    (path / "a.obj").write_text("mtllib a.mtl\nusemtl a\n" + obj(V, []) + places + faces)
    return imported(path / "a.obj")


# In the middle of each quarter of the bracket that is not its opening.
MIDDLES = np.array([(0.01, 0.01, 0.03), (0.05, 0.01, 0.03), (0.01, 0.04, 0.03), (0.05, 0.04, 0.03)])


@pytest.mark.parametrize("statement", ["map_Kd my wood.png", "map_Kd -clamp on -s 1 1 my wood.png"])
def test_texture_of_an_obj(tmp_path, statement):
    shown = colours_of(textured(tmp_path, "my wood.png", statement), MIDDLES)
    np.testing.assert_allclose(shown, QUARTERS, atol=1e-9)


def test_missing_texture_is_mentioned(tmp_path):
    (repair,) = textured(tmp_path, "b.png", "map_Kd a.png").repairs
    assert repair == "the texture of the material 'a' is missing: a.png: no such file"


def textured_glb(folder: Path, change: Callable[[dict[str, Any]], object]) -> ImportedModel:
    """The bracket with a texture across its x and y, half as bright, and its JSON changed."""
    write_texture(folder / "a.png")
    with Image.open(folder / "a.png") as image:
        material = PBRMaterial(baseColorTexture=image, baseColorFactor=[128, 128, 128, 255])
        mesh = SPLIT.copy()
        places = mesh.vertices[:, :2] / (0.06, 0.05)
        mesh.visual = trimesh.visual.TextureVisuals(uv=places, material=material)
        scene = trimesh.Scene(mesh)
        content = trimesh.exchange.gltf.export_glb(scene, tree_postprocessor=change)
    (folder / "a.glb").write_bytes(content)
    return imported(folder / "a.glb")


def test_texture_and_factor_of_a_glb(tmp_path):
    """The factor is linear, the texture sRGB."""
    half = float(encoded(np.array(128 / 255)))
    found = textured_glb(tmp_path, lambda tree: None)
    assert found.repairs == ()
    np.testing.assert_allclose(colours_of(found, MIDDLES), half * np.array(QUARTERS), atol=1e-9)


def move_texture(tree: dict[str, Any]) -> None:
    texture = tree["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
    texture["extensions"] = {"KHR_texture_transform": {"offset": [0.5, 0]}}


@pytest.mark.parametrize(
    ("change", "repair"),
    [
        (move_texture, "textures may be misplaced"),
        (lambda tree: tree["images"][0].update(bufferView=0), "cannot be read as an image"),
    ],
)
def test_textures_that_are_not_shown_as_stated_are_mentioned(tmp_path, change, repair):
    (said,) = textured_glb(tmp_path, change).repairs
    assert repair in said


def vertex_colours(path: Path) -> None:
    """The bracket with a colour at every vertex."""
    if path.suffix == ".obj":
        rows = obj(np.hstack([V, SHADES / 255]), T)
        path.write_text(rows)
        return
    shades = SHADES
    if path.suffix == ".glb":  # linear
        shades = np.round(255 * (SHADES / 255) ** 2.2).astype(np.uint8)
    mesh = trimesh.Trimesh(V, T, process=False)
    mesh.visual = trimesh.visual.ColorVisuals(mesh, vertex_colors=shades)
    mesh.export(path)


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".glb"])
def test_colours_of_vertices(tmp_path, suffix):
    vertex_colours(tmp_path / f"a{suffix}")
    found = imported(tmp_path / f"a{suffix}")
    assert found.repairs == ()
    np.testing.assert_allclose(colours_of(found, V), SHADES / 255, atol=0.03)


def test_colours_of_faces_of_a_ply(tmp_path):
    mesh = trimesh.Trimesh(V, T, process=False)
    mesh.visual = trimesh.visual.ColorVisuals(mesh, face_colors=SHADES[T[:, 0]])
    mesh.export(tmp_path / "a.ply")
    shown = colours_of(imported(tmp_path / "a.ply"), V[T].mean(axis=1))
    np.testing.assert_allclose(shown, SHADES[T[:, 0]] / 255, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "content", "repair"),
    [
        ("a.obj", obj(np.hstack([V, 1.0 * SHADES]), T), "must be from 0 to 1"),
        ("a.obj", obj(V, T).replace("\n", " 1 0 0\n", 1), "some vertices have none"),
        ("a.stl", binary_stl(V, T)[:-2] + b"\0\x80", "programs disagree"),
    ],
)
def test_colours_without_a_clear_meaning_are_ignored(tmp_path, name, content, repair):
    path = tmp_path / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    found = imported(path)
    assert len(found.repairs) == 1
    assert repair in found.repairs[0]
    assert found.model.parts[0].material == GREY


def test_colours_leave_the_shape_alone(tmp_path):
    vertex_colours(tmp_path / "a.obj")
    (tmp_path / "b.obj").write_text(obj(V, T))
    surfaces = [
        part_surface(scaled_parts(imported(tmp_path / name).model, 1.0), 1e-5, 0.01)
        for name in ("a.obj", "b.obj")
    ]
    assert (surfaces[0].vertices == surfaces[1].vertices).all()
    assert (surfaces[0].faces == surfaces[1].faces).all()


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_rendered_parts_have_the_colours(tmp_path, scale):
    """One mesh a material, with colours at its vertices where they vary."""
    vertex_colours(tmp_path / "a.ply")
    visual = tmp_path / "visual.glb"
    found = imported(tmp_path / "a.ply")
    visual.write_bytes(visual_glb(ImportedModel(found.model, scale), 40.0))
    (part,) = load_parts(visual)
    expected = found.model.colours.at(part.vertices / scale)[1]
    shown = part.base_colour * part.tints
    np.testing.assert_allclose(shown, expected, atol=0.06)
    np.testing.assert_allclose(part.tints.mean(axis=0), 1)
    visual.write_bytes(visual_glb(two_materials(tmp_path, "newmtl a\nKd 1 0 0\n"), 40.0))
    parts = load_parts(visual)
    assert [part.tints for part in parts] == [None, None]
    assert {tuple(part.base_colour.round(2)) for part in parts} == {RED, (0.34, 0.34, 0.32)}


def test_companions_are_the_files_that_colours_need(tmp_path):
    textured(tmp_path, "my wood.png", "map_Kd my wood.png")
    names = [str(tmp_path / name) for name in ("a.mtl", "my wood.png")]
    assert companions(tmp_path / "a.obj") == names
    (tmp_path / "my wood.png").unlink()
    assert companions(tmp_path / "a.obj") == names[:1]
    assert companions(tmp_path / "a.mtl") == []
