"""A user's mesh file, read and checked: every face it states, and nothing else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.objects.bodies import BODY
from grasptypes.objects.glb_file import read_glb
from grasptypes.objects.mesh_limits import check_faces, check_file_size
from grasptypes.objects.obj_file import read_obj
from grasptypes.objects.ply_file import ply_faces, read_ply
from grasptypes.objects.polygons import PolygonMesh
from grasptypes.objects.stl_file import read_stl
from grasptypes.settings.objects import ImportLimits

FORMATS = (".stl", ".obj", ".ply", ".glb")


def read_meshes(
    path: Path, limits: ImportLimits, remarks: list[str]
) -> dict[str, list[trimesh.Trimesh]]:
    """Read the meshes of a file by name, in the file's unit; a single one is called `body`.

    A mesh may have several pieces, as the file divides it. Only a GLB has several meshes: the
    objects, groups, materials and solids of other files are one body.

    Args:
        remarks: receives what was doubtful, in words.

    Raises:
        InputError: the file is no mesh, is damaged, or exceeds the limits.
    """
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise InputError(path, "", f"is not a supported mesh format ({', '.join(FORMATS)})")
    if not path.is_file():
        raise InputError(path, "", "no such file")
    check_file_size(path, limits)
    if suffix == ".glb":
        meshes = read_glb(path)
    else:
        if suffix == ".stl":
            solids = read_stl(path)
        else:
            solids = [read_obj(path) if suffix == ".obj" else ply_faces(path, read_ply(path))]
        meshes = {BODY: [_triangulated(path, solid, remarks) for solid in solids]}
    pieces = [piece for some in meshes.values() for piece in some]
    if not any(len(piece.faces) for piece in pieces):
        raise InputError(path, "", "has no faces: a triangle mesh is needed")
    check_faces(path, pieces, limits)
    for piece in pieces:
        _check_vertices(path, piece.vertices, piece.faces)
    return {BODY: next(iter(meshes.values()))} if len(meshes) == 1 else meshes


def _triangulated(path: Path, polygons: PolygonMesh, remarks: list[str]) -> trimesh.Trimesh:
    """Cut faces into triangles; raises InputError if a face has missing vertices."""
    _check_vertices(path, polygons.vertices, polygons.corners)
    faces, found = polygons.triangles()
    remarks += found
    return trimesh.Trimesh(polygons.vertices, faces, process=False)


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
        raise InputError(path, "", f"{bad} vertices are not finite (NaN or infinite)")
