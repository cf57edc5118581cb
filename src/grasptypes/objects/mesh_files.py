"""A user's mesh file, read and checked: every face it states, with its colours."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.objects.bodies import BODY
from grasptypes.objects.file_formats import MESHES
from grasptypes.objects.glb_file import read_glb
from grasptypes.objects.mesh_limits import check_faces, check_file_size
from grasptypes.objects.obj_file import read_obj
from grasptypes.objects.ply_file import ply_faces, read_ply
from grasptypes.objects.polygons import PolygonMesh
from grasptypes.objects.stl_file import read_stl
from grasptypes.objects.surface_colours import FaceColours, plain
from grasptypes.settings.objects import ImportLimits


class MeshFile(NamedTuple):
    """What a file states, in its unit."""

    meshes: dict[str, list[trimesh.Trimesh]]
    """Each mesh by name, in pieces as the file divides it; a single one is called `body`."""
    colours: list[FaceColours]
    """The colours of each piece, one mesh after the other; grey where the file has none."""


def read_meshes(path: Path, limits: ImportLimits, remarks: list[str]) -> MeshFile:
    """Read the meshes of a file and their colours.

    Only a GLB has several meshes: the objects, groups, materials and solids of other files are
    one body.

    Args:
        remarks: receives what was doubtful, in words.

    Raises:
        InputError: the file is no mesh, is damaged, or exceeds the limits.
    """
    suffix = path.suffix.lower()
    if suffix not in MESHES:
        raise InputError(path, "", f"is not a supported mesh format ({', '.join(MESHES)})")
    if not path.is_file():
        raise InputError(path, "", "no such file")
    check_file_size(path, limits)
    if suffix == ".glb":
        meshes, colours = read_glb(path, remarks)
    else:
        solids = _read_solids(path, suffix, remarks)
        cut = [_triangulated(path, solid, remarks) for solid in solids]
        meshes, colours = {BODY: [mesh for mesh, _ in cut]}, [some for _, some in cut]
    pieces = [piece for some in meshes.values() for piece in some]
    if not any(len(piece.faces) for piece in pieces):
        raise InputError(path, "", "has no faces: a triangle mesh is needed")
    check_faces(path, pieces, limits)
    for piece in pieces:
        _check_vertices(path, piece.vertices, piece.faces)
    if len(meshes) == 1:
        meshes = {BODY: pieces}
    shown = [
        plain(len(piece.faces)) if some is None else some
        for piece, some in zip(pieces, colours, strict=True)
    ]
    return MeshFile(meshes, shown)


def _read_solids(path: Path, suffix: str, remarks: list[str]) -> list[PolygonMesh]:
    if suffix == ".stl":
        return read_stl(path, remarks)
    if suffix == ".obj":
        return [read_obj(path, remarks)]
    return [ply_faces(path, read_ply(path), remarks)]


def _triangulated(
    path: Path, polygons: PolygonMesh, remarks: list[str]
) -> tuple[trimesh.Trimesh, FaceColours | None]:
    """Cut faces into triangles; raises InputError if a face has missing vertices."""
    _check_vertices(path, polygons.vertices, polygons.corners)
    cut, found = polygons.triangles()
    remarks += found
    mesh = trimesh.Trimesh(polygons.vertices, polygons.corners[cut], process=False)
    if polygons.colours is None:
        return mesh, None
    owners = np.repeat(np.arange(len(polygons.sizes)), polygons.sizes - 2)
    return mesh, polygons.colours.cut(cut, owners)


def _check_vertices(path: Path, vertices: NDArray[np.float64], corners: NDArray[np.int64]) -> None:
    """Reject missing vertices, and positions that are no numbers; raises InputError."""
    count = len(vertices)
    missing = corners[(corners < 0) | (corners >= count)]
    if len(missing):
        message = (
            f"a face refers to vertex {missing[0]}, but the file has {count} (numbered from 0)"
        )
        raise InputError(path, "face", message)
    bad = int((~np.isfinite(vertices).all(axis=1)).sum())
    if bad:
        raise InputError(path, "", f"{bad} of {count} vertices are not finite (NaN or infinite)")
