"""Every face of a mesh file is read, whatever way the format allows to write it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.unit.objects.mesh_texts import (
    BRACKET,
    COLLINEAR,
    RING,
    Prism,
    binary_stl,
    glb,
    obj,
    ply,
    stl,
    strips_ply,
    triangles,
)
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.objects.bodies import concatenated
from grasptypes.objects.mesh_files import read_meshes
from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.parts import ImportedModel
from grasptypes.objects.polygons import PolygonMesh
from grasptypes.settings.objects import OwnObject

LIMITS = PARAMS.objects.import_.changed(rebuild_cells=32)
V, T = BRACKET.vertices, triangles()
NONE = V[:0]
OBJ, STL = obj(V, T), stl(V, T)
APART, ABOVE = V + [0.1, 0, 0], V + [0, 0, 0.03]
SECOND = np.array(T) + len(V)  # faces of a second body's vertices
WITH_NORMALS = "vn 0 0 1\nvt 0 0\n" + obj(V, []) + "".join(
    "f " + " ".join(f"{k + 1}/1/1" for k in face) + "\n" for face in BRACKET.faces
)  # fmt: skip


def imported(path: Path) -> ImportedModel:
    return import_model(OwnObject(file=str(path), unit="m", density_kg_m3=1.0), LIMITS)


def check(path: Path, content: str | bytes, expected: Prism, bodies: int = 1) -> None:
    """A file has the surface and volume of the expected solids, and is one closed `body`."""
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    remarks: list[str] = []
    read = concatenated(read_meshes(path, LIMITS, remarks).meshes["body"])
    assert remarks == []
    assert read.area == pytest.approx(bodies * expected.area_m2, rel=1e-5)
    assert read.volume == pytest.approx(bodies * expected.volume_m3, rel=1e-5)
    found = imported(path)
    assert found.repairs == (() if bodies == 1 else (f"joined {bodies} bodies",))
    (part,) = found.model.parts
    assert part.name == "body"
    assert part.solid.volume() == pytest.approx(bodies * expected.volume_m3, rel=1e-5)
    assert part.solid.surface_area() == pytest.approx(bodies * expected.area_m2, rel=1e-5)


@pytest.mark.parametrize("shape", [BRACKET, COLLINEAR, RING], ids=["concave", "collinear", "hole"])
@pytest.mark.parametrize("turn", [0, 3])
def test_faces_of_many_corners(tmp_path, shape, turn):
    """Concave faces, corners on a line, and holes, wherever a face begins."""
    faces = [[*face[turn:], *face[:turn]] for face in shape.faces]
    check(tmp_path / "a.obj", obj(shape.vertices, faces), shape)
    check(tmp_path / "relative.obj", obj(shape.vertices, faces, relative=True), shape)
    for order in ("", "<", ">"):
        check(tmp_path / "a.ply", ply(shape.vertices, faces, order), shape)
    check(tmp_path / "a.stl", stl(shape.vertices, faces), shape)


@pytest.mark.parametrize(
    "content",
    [
        OBJ,
        obj(V, T, sep="\t"),
        OBJ.replace("\n", "\r\n"),
        OBJ.replace("\n", "\r"),
        "\ufeff" + OBJ,
        OBJ.replace("\n", " # from a tool\n"),
        OBJ.upper(),
        "mtllib gone.mtl\no thing\ng a b\ns off\n" + OBJ,
        WITH_NORMALS,
        obj(V, BRACKET.faces).replace("f 9 10 ", "f 9 10 \\\n"),
        OBJ.encode("utf-16"),
    ],
)
def test_ways_to_write_an_obj(tmp_path, content):
    check(tmp_path / "a.obj", content, BRACKET)


def test_materials_of_an_obj_do_not_divide_it(tmp_path):
    """Not even if each material has vertices of its own."""
    (tmp_path / "a.mtl").write_text("newmtl wood\nKd 1 0 0\n")
    check(
        tmp_path / "a.obj",
        "mtllib a.mtl\n" + obj(V, T[:9]) + "usemtl wood\n" + obj(NONE, T[9:]),
        BRACKET,
    )
    halves = "mtllib a.mtl\n" + obj(V, T[:9]) + "usemtl wood\n" + obj(V, []) + obj(NONE, SECOND[9:])
    check(tmp_path / "b.obj", halves, BRACKET)


def test_bodies_between_each_other_in_an_obj(tmp_path):
    absolute = OBJ + obj(APART, []) + obj(NONE, SECOND)
    check(tmp_path / "two.obj", absolute, BRACKET, bodies=2)
    relative = obj(V, T, relative=True) + obj(APART, T, relative=True)
    check(tmp_path / "relative.obj", relative, BRACKET, bodies=2)


@pytest.mark.parametrize(
    "content",
    [
        STL,
        STL.upper(),
        STL.title(),
        STL.replace("endsolid", "end solid").replace("endfacet", "end facet"),
        stl(V, T, name=""),
        stl(V, T, name=" a solid facet: loop no. 7"),
        STL.replace(" ", "\t"),
        STL.replace("\n", "\r\n"),
        STL.replace("\n", "\r"),
        "\ufeff" + STL,
        STL.replace("facet normal 0 0 0\n", "facet normal 0 0 0 "),
        binary_stl(V, T),
    ],
)
def test_ways_to_write_an_stl(tmp_path, content):
    check(tmp_path / "a.stl", content, BRACKET)


@pytest.mark.parametrize("spare", [b"\n", bytes(10), bytes(49)])
def test_an_stl_may_have_some_bytes_at_its_end(tmp_path, spare):
    check(tmp_path / "a.stl", binary_stl(V, T) + spare, BRACKET)


@pytest.mark.parametrize("stated", [0, 6, len(T) - 1, len(T) + 1, 2**32 - 1])
def test_an_stl_is_never_read_in_part(tmp_path, stated):
    whole = binary_stl(V, T)
    (tmp_path / "a.stl").write_bytes(whole[:80] + stated.to_bytes(4, "little") + whole[84:])
    with pytest.raises(InputError, match=f"should have {stated} triangles, but has {len(T)}"):
        read_meshes(tmp_path / "a.stl", LIMITS, [])


def test_strips_of_a_ply(tmp_path):
    """The side of the bracket as one strip; caps as faces, as strips, and joined to one."""
    side = [k for low in [*range(8), 0] for k in (low + 8, low)]
    caps = T[:12]
    joined = [corner for a, b, c in caps for corner in (a, a, a, b, c, c)]
    for order in ("", "<", ">"):
        check(tmp_path / "faces.ply", strips_ply([side], caps, order), BRACKET)
        check(tmp_path / "strips.ply", strips_ply([side, [], *caps], order=order), BRACKET)
        check(tmp_path / "joined.ply", strips_ply([side, joined], order=order), BRACKET)


def test_solids_of_an_stl_are_one_body(tmp_path):
    check(tmp_path / "two.stl", STL + stl(APART, T, " other").upper(), BRACKET, bodies=2)
    check(tmp_path / "patches.stl", stl(V, T[:7], " inlet") + stl(V, T[7:], " walls"), BRACKET)


@pytest.mark.parametrize(
    ("name", "content"),
    [("a.stl", STL + stl(ABOVE, T, " b")), ("a.obj", OBJ + obj(ABOVE, []) + obj(NONE, SECOND))],
)
def test_bodies_that_touch_stay_apart(tmp_path, name, content):
    (tmp_path / name).write_text(content)
    found = imported(tmp_path / name)
    assert found.repairs == ("joined 2 bodies",)
    (part,) = found.model.parts
    caps_m2 = 2 * BRACKET.volume_m3 / 0.03
    assert part.solid.surface_area() == pytest.approx(2 * BRACKET.area_m2 - caps_m2)
    assert part.solid.volume() == pytest.approx(2 * BRACKET.volume_m3)


def test_ways_to_write_a_ply(tmp_path):
    for order in ("", "<", ">"):
        check(tmp_path / "long.ply", ply(V, BRACKET.faces, order, size="int"), BRACKET)
    for end in (b"\r\n", b"\r"):
        head, mark, body = ply(V, BRACKET.faces, "<").partition(b"end_header\n")
        check(tmp_path / "a.ply", (head + mark).replace(b"\n", end) + body, BRACKET)
        check(tmp_path / "b.ply", ply(V, BRACKET.faces).replace(b"\n", end), BRACKET)
    check(tmp_path / "bom.ply", b"\xef\xbb\xbf" + ply(V, BRACKET.faces), BRACKET)


@pytest.mark.parametrize(
    ("points", "remark"),
    [
        ([(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 2, 0)], "cut 1 faces that cross themselves"),
        ([(0, 0, 0), (1, 0, 0), (1, 1, 0.5), (0, 1, 0)], "cut 1 faces that are not flat"),
    ],
)
def test_doubtful_faces_are_mentioned(points, remark):
    mesh = PolygonMesh(np.array(points, dtype=float), np.arange(4), np.array([4]))
    faces, remarks = mesh.triangles()
    assert faces.shape == (2, 3)
    assert remarks == [remark]


def test_a_bent_concave_face_stays_closed(tmp_path):
    lifted = V + np.outer(np.isin(np.arange(16), [10, 11]), [0, 0, 0.02])
    (tmp_path / "a.obj").write_text(obj(lifted, BRACKET.faces))
    found = imported(tmp_path / "a.obj")
    assert found.repairs == ("cut 1 faces that are not flat",)
    assert found.model.parts[0].solid.volume() > BRACKET.volume_m3


def bracket_glb(**keywords: object) -> bytes:
    return glb(V.astype("<f4"), [np.array(T)], **keywords)


def test_pieces_of_a_glb_mesh_are_one_body(tmp_path):
    check(tmp_path / "one.glb", bracket_glb(), BRACKET)
    check(tmp_path / "two.glb", glb(V.astype("<f4"), [np.array(T[:9]), np.array(T[9:])]), BRACKET)
    check(tmp_path / "unmoved.glb", bracket_glb(node={"weights": [0, 0.0]}), BRACKET)
    check(tmp_path / "mirrored.glb", bracket_glb(node={"scale": [-1, 1, 1]}), BRACKET)


@pytest.mark.parametrize(
    ("kind", "normalized"),
    [("i2", True), ("u2", True), ("i2", False), ("u2", False), ("i1", True), ("u1", False)],
)
def test_quantized_positions_are_decoded(tmp_path, kind, normalized):
    """The node's scale turns integers, or shares of the largest one, into metres."""
    largest = np.iinfo(kind).max
    content = glb(
        np.round(V / 0.06 * largest).astype(f"<{kind}"),
        [np.array(T)],
        node={"scale": [0.06 if normalized else 0.06 / largest] * 3},
        normalized=normalized,
        extensionsRequired=["KHR_mesh_quantization"],
    )
    (tmp_path / "a.glb").write_bytes(content)
    read = concatenated(read_meshes(tmp_path / "a.glb", LIMITS, []).meshes["body"])
    assert read.extents == pytest.approx([0.06, 0.05, 0.03], abs=0.06 / largest)
    assert read.is_watertight


@pytest.mark.parametrize(
    ("content", "named"),
    [
        (bracket_glb(extensionsRequired=["KHR_draco_mesh_compression"]), "KHR_draco_mesh_comp"),
        (bracket_glb(extensionsRequired=["EXT_meshopt_compression"]), "EXT_meshopt_compression"),
        (bracket_glb(extensionsUsed=["EXT_mesh_gpu_instancing"]), "EXT_mesh_gpu_instancing"),
        (bracket_glb().replace(b'"normalized": false', b'"sparse": {}       '), "sparse acc"),
        (bracket_glb(node={"skin": 0}, skins=[{"joints": [0]}]), "a skeleton"),
        (bracket_glb(node={"weights": [0, 0.5]}), "morph target"),
        (bracket_glb().replace(b'"scenes"', b'"scenez"'), "has no scene"),
        (bracket_glb(mode=6), "has 82 triangles, but only 0"),
        (bracket_glb()[:-90], "truncated"),
    ],
)
def test_what_a_glb_needs_is_named(tmp_path, content, named):
    (tmp_path / "a.glb").write_bytes(content)
    with pytest.raises(InputError, match=named):
        read_meshes(tmp_path / "a.glb", LIMITS, [])


def test_extensions_that_leave_the_shape_alone_are_accepted(tmp_path):
    content = bracket_glb(extensionsRequired=["KHR_materials_unlit", "KHR_texture_transform"])
    check(tmp_path / "a.glb", content, BRACKET)
