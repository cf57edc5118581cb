"""A user's own mesh: read, checked, repaired and turned into an object model."""

from __future__ import annotations

from pathlib import Path
from typing import cast

import igl
import numpy as np
import trimesh
from manifold3d import Manifold, Mesh64
from numpy.typing import NDArray

from grasptypes.errors import InputError, parsing
from grasptypes.objects import solids
from grasptypes.objects.mesh_limits import (
    check_counts,
    check_faces,
    check_file,
    check_size,
    check_volume,
)
from grasptypes.objects.parts import ImportedModel, Material, ObjectModel, Part
from grasptypes.objects.units import UNITS_M
from grasptypes.settings.objects import ImportLimits, OwnObject

FORMATS = (".stl", ".obj", ".ply", ".glb")
GREY = Material((0.62, 0.62, 0.60, 1.0), roughness=0.6)


def import_model(own: OwnObject, limits: ImportLimits) -> ImportedModel:
    """Make a model of a user's mesh.

    Args:
        limits: what the mesh must meet.

    Raises:
        InputError: the mesh cannot be used; the message says why.
    """
    path, unit, scale = own.file, own.unit, own.scale
    meshes = _read(path, UNITS_M[unit], limits)
    check_size(path, meshes, unit, scale, limits)
    repairs: list[str] = []
    parts = []
    for name, mesh in meshes.items():
        solid = _mended(mesh, repairs)
        if solid is not None:
            parts.append(Part(name, solid, GREY))
    if len(parts) < len(meshes):
        whole = _tidy(cast(trimesh.Trimesh, trimesh.util.concatenate(list(meshes.values()))), [])
        repairs = []  # earlier repairs have no effect on the rebuilt surface
        parts = [Part("body", _rebuild(path, whole, limits, repairs), GREY)]
    check_volume(path, sum(part.solid.volume() for part in parts), meshes, limits)
    # With a given mass any density will do: the inertia is scaled to the mass.
    model = ObjectModel(tuple(parts), own.density_kg_m3 or 1e3, own.shell_thickness_m)
    return ImportedModel(model, scale, own.mass_kg, tuple(dict.fromkeys(repairs)))


def _read(path: str | Path, metres: float, limits: ImportLimits) -> dict[str, trimesh.Trimesh]:
    """Read the geometries of a mesh file by name, in metres; a single one is called `body`."""
    path = Path(path)
    if path.suffix.lower() not in FORMATS:
        raise InputError(path, "", f"is not a supported mesh format ({', '.join(FORMATS)})")
    if not path.is_file():
        raise InputError(path, "", "no such file")
    check_file(path, limits)
    with parsing(path, "cannot be read as a mesh"):
        scene = trimesh.load_scene(path, process=False)
        geometries = {
            name: mesh
            for name, mesh in _placed(scene).items()
            if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces)
        }
    if not geometries:
        raise InputError(path, "", "has no faces: a triangle mesh is needed")
    check_faces(path, geometries, limits)
    for mesh in geometries.values():
        check_counts(path, mesh)
        _check_corners(path, mesh)
        if not np.isfinite(mesh.vertices).all():
            bad = int((~np.isfinite(mesh.vertices).all(axis=1)).sum())
            raise InputError(path, "", f"{bad} vertices are not finite (NaN or infinite)")
        mesh.apply_scale(metres)
    if len(geometries) == 1:
        return {"body": next(iter(geometries.values()))}
    return geometries


def _check_corners(path: Path, mesh: trimesh.Trimesh) -> None:
    """Reject faces with missing vertices; raises InputError."""
    count = len(mesh.vertices)
    missing = mesh.faces[(mesh.faces < 0) | (mesh.faces >= count)]
    if len(missing):
        message = (
            f"a face refers to vertex {missing[0]}, but the file has {count} (numbered from 0)"
        )
        raise InputError(path, "face", message)


def _placed(scene: trimesh.Scene) -> dict[str, trimesh.Trimesh]:
    """Return a scene's geometries in the scene's frame."""
    placed = {}
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        placed[str(node)] = scene.geometry[name].copy()
        placed[str(node)].apply_transform(transform)
    return placed


def _mended(mesh: trimesh.Trimesh, repairs: list[str]) -> Manifold | None:
    """Return the solid of a mesh if it closes with or without degenerate and duplicate faces."""
    merged = trimesh.Trimesh(mesh.vertices, mesh.faces, process=True)
    # A face without area may close a seam, so these are only dropped if necessary.
    for tidy in (False, True):
        done: list[str] = []
        solid = _solid(_tidy(merged, done) if tidy else merged, done)
        if solid is not None:
            repairs += done
            return solid
    return None


def _tidy(mesh: trimesh.Trimesh, repairs: list[str]) -> trimesh.Trimesh:
    """Merge equal vertices and drop faces that have no area or are duplicates."""
    mesh = trimesh.Trimesh(mesh.vertices, mesh.faces, process=True)
    before = len(mesh.faces)
    mesh.update_faces(mesh.nondegenerate_faces() & mesh.unique_faces())
    mesh.remove_unreferenced_vertices()
    if len(mesh.faces) < before:
        repairs.append(f"dropped {before - len(mesh.faces)} degenerate or double faces")
    return mesh


def _solid(mesh: trimesh.Trimesh, repairs: list[str]) -> Manifold | None:
    """Return the union of a mesh's bodies, or None if one of them is not closed."""
    bodies = mesh.split(only_watertight=False)
    pieces = []
    for body in bodies:
        if not body.is_watertight and body.fill_holes():
            repairs.append("filled small holes")
        if not body.is_winding_consistent or body.volume < 0:
            trimesh.repair.fix_normals(body)
            repairs.append("turned faces outwards")
        piece = Manifold(
            Mesh64(
                np.ascontiguousarray(body.vertices, dtype=np.float64),
                np.ascontiguousarray(body.faces, dtype=np.uint64),
            )
        )
        if piece.is_empty():
            return None
        pieces.append(piece)
    if len(pieces) > 1:
        repairs.append(f"joined {len(pieces)} bodies")
    return solids.union(*pieces)


def _rebuild(
    path: str | Path, mesh: trimesh.Trimesh, limits: ImportLimits, repairs: list[str]
) -> Manifold:
    """Rebuild the surface of the volume that a leaky mesh encloses by its winding number."""
    spacing_m = float(mesh.extents.max()) / limits.rebuild_cells
    origin_m = mesh.bounds[0] - 3 * spacing_m
    shape = np.ceil((mesh.bounds[1] - origin_m) / spacing_m).astype(int) + 4
    nodes = np.ascontiguousarray(np.indices(shape).reshape(3, -1).T * spacing_m + origin_m)
    vertices = np.ascontiguousarray(mesh.vertices, dtype=np.float64)
    faces = np.ascontiguousarray(mesh.faces, dtype=np.int64)
    winding = np.abs(igl.fast_winding_number(vertices, faces, nodes))
    unsure = int(((winding > 0.25) & (winding < 0.75)).sum())
    enclosed = int((winding >= 0.75).sum())
    if unsure > limits.max_open_share * enclosed:
        raise InputError(
            path, "", "is an open shell without volume: close its holes or give its walls thickness"
        )
    distances = np.sqrt(igl.point_mesh_squared_distance(nodes, vertices, faces)[0])
    values = np.where(winding > 0.5, -distances, distances)
    solid = _marched(values.reshape(shape), nodes)
    repairs.append(f"closed holes by rebuilding the surface at {1e3 * spacing_m:.1f} mm")
    return solid


def _marched(values: NDArray[np.float64], nodes: NDArray[np.float64]) -> Manifold:
    """Return the solid of negative values (nx, ny, nz) at nodes (nx * ny * nz, 3)."""
    nx, ny, nz = values.shape
    # In libigl's grids, x varies fastest.
    order = np.arange(nodes.shape[0]).reshape(values.shape).transpose(2, 1, 0).reshape(-1)
    vertices, faces = igl.marching_cubes(
        np.ascontiguousarray(values.reshape(-1)[order], dtype=np.float64),
        np.ascontiguousarray(nodes[order]),
        nx,
        ny,
        nz,
        0.0,
    )[:2]
    solid = solids.from_mesh(vertices, faces)
    return solid if solid.volume() > 0 else solids.from_mesh(vertices, faces[:, ::-1])
