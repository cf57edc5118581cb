"""Mistakes in a user's own mesh."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import trimesh
from case import PARAMS, Case, Content, library

from grasptypes.objects.mesh_import import import_model
from grasptypes.settings.objects import ImportLimits, OwnObject

LIMITS = ImportLimits.check(PARAMS["objects"]["import"]).changed(rebuild_cells=32)

BOX = trimesh.creation.box((0.05, 0.05, 0.05))
VERTICES, FACES = BOX.vertices.tolist(), (BOX.faces + 1).tolist()
CUPBOARD = trimesh.creation.box((0.6, 0.6, 1.0)).export(file_type="stl")
TEXT_STL = BOX.export(file_type="stl_ascii").encode()
TEXT_PLY = BOX.export(file_type="ply", encoding="ascii")
STL_CUT = TEXT_STL.replace(b"endloop", b"", 1)
STL_OF_TWO = re.sub(rb"vertex \S+ \S+ \S+", b"", TEXT_STL, count=1)
INNER = trimesh.creation.box((0.04, 0.04, 0.04))
INNER.invert()
HOLLOW = trimesh.util.concatenate([BOX, INNER]).export(file_type="stl")
STL, PLY, GLB = (BOX.export(file_type=kind) for kind in ("stl", "ply", "glb"))
# The first of two chunks alone: its JSON names accessors, whose data are not there.
GLB_WITHOUT_DATA = GLB[: 20 + int.from_bytes(GLB[12:16], "little")]
# The box's indices come first in its data; the last one is another.
LAST_INDEX = len(GLB_WITHOUT_DATA) + 8 + 4 * (3 * len(FACES) - 1)
GLB_COMPRESSED = trimesh.exchange.gltf.export_glb(
    trimesh.Scene(BOX),
    tree_postprocessor=lambda tree: tree.update(extensionsRequired=["KHR_draco_mesh_compression"]),
)
GLB_WITH_BONES = trimesh.exchange.gltf.export_glb(
    trimesh.Scene(BOX),
    tree_postprocessor=lambda tree: [node.update(skin=0) for node in tree["nodes"]],
)
GLB_WITH_99 = GLB[:LAST_INDEX] + struct.pack("<I", 99) + GLB[LAST_INDEX + 4 :]


def mesh(
    what: str,
    name: str,
    content: Content,
    *names: str,
    unit: str = "m",
    wall_m: float | None = None,
) -> Case:
    """A mesh that `objects.own.thing` names."""
    own = OwnObject(file=name, unit=unit, density_kg_m3=1000.0, shell_thickness_m=wall_m)
    return Case("mesh", what, {name: content}, library(import_model, own, LIMITS), (name, *names))


def obj(vertices: Iterable[Iterable[object]], faces: Iterable[Iterable[object]]) -> str:
    """A Wavefront OBJ."""
    rows = [("v", *vertex) for vertex in vertices] + [("f", *face) for face in faces]
    return "\n".join(" ".join(map(str, row)) for row in rows) + "\n"


def first(x: object) -> list[list[object]]:
    """The box's vertices with another first coordinate."""
    return [[x, 0, 0], *VERTICES[1:]]


def stl_with(number: float) -> bytes:
    """The box as STL with another first coordinate."""
    return STL[:96] + struct.pack("<f", number) + STL[100:]


def ply_row(face: str) -> bytes:
    """The box as PLY in text, with another last face."""
    return TEXT_PLY.rstrip().rpartition(b"\n")[0] + f"\n{face}\n".encode()


def huge_stl(path: Path) -> None:
    """A file of the size and header of ten million faces, which takes no room on the disk."""
    path.write_bytes(bytes(80) + struct.pack("<I", 10_000_000))
    with path.open("r+b") as file:
        file.truncate(84 + 50 * 10_000_000)


def fine_ply(path: Path) -> None:
    """A square of more faces than are allowed, in a file that is small enough."""
    side = int((LIMITS.max_faces / 2) ** 0.5) + 2
    corner = (np.arange((side - 1) ** 2) // (side - 1)) * side + np.arange((side - 1) ** 2) % (
        side - 1
    )
    triangles = np.concatenate(
        [corner[:, None] + [0, 1, side], corner[:, None] + [1, side + 1, side]]
    )
    points = np.indices((side, side)).reshape(2, -1).T * 0.1 / side
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {side**2}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.zeros(len(triangles), dtype=[("n", "u1"), ("corners", "<i4", 3)])
    rows["n"], rows["corners"] = 3, triangles
    flat = np.column_stack([points, np.zeros(len(points))]).astype("<f4")
    path.write_bytes(head.encode() + flat.tobytes() + rows.tobytes())


CASES = [
    mesh("empty", "cup.stl", b"", "not a complete STL"),
    mesh("text named .stl", "cup.stl", "a cup\n", "not a complete STL"),
    mesh("a truncated binary STL", "cup.stl", STL[:300], "not a complete STL"),
    mesh("an STL of more than it says", "cup.stl", STL[:80] + bytes([6]) + STL[81:], "6", "has 12"),
    mesh("a truncated text STL", "cup.stl", TEXT_STL[:-300], "not a complete STL"),
    mesh("a truncated text PLY", "cup.ply", TEXT_PLY[:-30], "face", "truncated"),
    mesh("a truncated PLY", "cup.ply", PLY[:-50], "face", "12", "truncated"),
    mesh("a truncated GLB", "cup.glb", GLB[:-200], "cannot be read as a mesh"),
    mesh(
        "random bytes named .glb", "cup.glb", np.random.default_rng(0).bytes(500), "cannot be read"
    ),
    mesh("a GLB without its data", "cup.glb", GLB_WITHOUT_DATA, "cannot be read as a mesh"),
    mesh("a misspelt PLY", "cup.ply", PLY.replace(b"list", b"lost"), "header", "property lost"),
    mesh(
        "a PLY header with billions of vertices",
        "cup.ply",
        PLY.replace(b"vertex 8", b"vertex 3000000000"),
        "vertex",
        "3000000000",
    ),
    mesh("NaN in text", "cup.obj", obj(first("nan"), FACES), "NaN"),
    mesh("NaN in a binary file", "cup.stl", stl_with(float("nan")), "NaN"),
    mesh("infinity", "cup.obj", obj(first("inf"), FACES), "not finite"),
    mesh("text instead of numbers", "cup.obj", obj(first("one"), FACES), "line 1", "'v one 0 0'"),
    mesh("a decimal comma", "cup.obj", obj(first("0,05"), FACES), "line 1", "three numbers"),
    mesh("a face with a missing vertex", "cup.obj", obj(VERTICES, [*FACES, (1, 2, 99)]), "98"),
    mesh("a face with vertex 0", "cup.obj", obj(VERTICES, [*FACES, (0, 1, 2)]), "line 21"),
    mesh("a relative vertex too many", "cup.obj", obj(VERTICES, [(-1, -2, -9)]), "'f -1 -2 -9'"),
    mesh("a face with two corners", "cup.obj", obj(VERTICES, [*FACES, (1, 2)]), "line 21"),
    mesh("a PLY face with two corners", "cup.ply", ply_row("2 0 1"), "three corners"),
    mesh("a PLY corner of half a vertex", "cup.ply", ply_row("3 0 1 1.5"), "face", "1.5"),
    mesh("a PLY row too short", "cup.ply", ply_row("3 0"), "face", "'3 0'"),
    mesh("text in a PLY", "cup.ply", TEXT_PLY.replace(b"-0.025", b"minus"), "vertex", "minus"),
    mesh(
        "text in an STL", "cup.stl", TEXT_STL.replace(b"vertex -", b"vertex x"), "vertex: 'x0.025'"
    ),
    mesh("an STL without one `endloop`", "cup.stl", STL_CUT, "12 facets begin, but 11"),
    mesh("an STL facet with two corners", "cup.stl", STL_OF_TWO, "loop", "three vertices"),
    mesh("a compressed GLB", "cup.glb", GLB_COMPRESSED, "KHR_draco_mesh_compression"),
    mesh("a GLB with a skeleton", "cup.glb", GLB_WITH_BONES, "skeleton", "without it"),
    mesh("a cavity and a wall", "cup.stl", HOLLOW, "shell_thickness_m", "cavity", wall_m=0.001),
    mesh(
        "a PLY face with a missing vertex",
        "cup.ply",
        ply_row("3 0 1 99"),
        "face: ",
        "99",
        "has 8",
    ),
    mesh(
        "a PLY face with a negative vertex", "cup.ply", ply_row("3 0 1 -1"), "face: ", "-1", "has 8"
    ),
    mesh(
        "a GLB face with a missing vertex",
        "cup.glb",
        GLB_WITH_99,
        "face: ",
        "99",
        "has 8",
    ),
    mesh("one face", "cup.obj", obj(VERTICES, FACES[:1]), "open shell without volume"),
    mesh("points without faces", "cup.obj", obj(VERTICES, []), "no faces"),
    mesh("flat", "cup.obj", obj([(x, y, 0) for x, y, _ in VERTICES], FACES), "no volume"),
    mesh("all vertices in one place", "cup.obj", obj([(0, 0, 0)] * 8, FACES), "unit"),
    mesh("half a box", "cup.obj", obj(VERTICES, FACES[:6]), "open shell without volume"),
    mesh("a cupboard", "cup.stl", CUPBOARD, "is 0.6 x 0.6 x 1 m", "0.125 m3"),
    mesh("a wrong unit", "cup.stl", STL, "unit", "5e-05 m", "m would fit", unit="mm"),
    mesh("ten million faces", "cup.stl", huge_stl, "500 MB", "the limit is 250 MB"),
    mesh("more faces than allowed", "cup.ply", fine_ply, "faces; the limit is 1000000"),
    mesh("not a mesh format", "cup.step", "ISO-10303-21;\n", ".stl, .obj, .ply, .glb"),
    mesh("a folder named .stl", "cup.stl", Path.mkdir, "no such file"),
]
