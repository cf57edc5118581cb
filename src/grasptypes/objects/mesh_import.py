"""A user's own mesh: read, checked, repaired and turned into an object model."""

from __future__ import annotations

import logging
from pathlib import Path

import igl
import numpy as np
import trimesh
from manifold3d import Manifold
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.objects import solids
from grasptypes.objects.bodies import BODY, assembled, closed_bodies, concatenated, tidied
from grasptypes.objects.mesh_files import read_meshes
from grasptypes.objects.mesh_limits import check_size, check_volume
from grasptypes.objects.parts import ImportedModel, ObjectModel, Part
from grasptypes.objects.surface_colours import GREY, joined
from grasptypes.objects.units import UNITS_M
from grasptypes.settings.objects import ImportLimits, OwnObject

LOGGER = logging.getLogger("grasptypes")


def import_model(own: OwnObject, limits: ImportLimits) -> ImportedModel:
    """Make a model of a user's mesh; what was repaired or ignored is logged.

    Args:
        limits: what the mesh must meet.

    Raises:
        InputError: the mesh cannot be used; the message says why.
    """
    path, unit, scale = own.file, own.unit, own.scale
    repairs: list[str] = []
    meshes, face_colours = read_meshes(Path(path), limits, repairs)
    pieces = [piece for some in meshes.values() for piece in some]
    for piece in pieces:
        piece.apply_scale(UNITS_M[unit])
    check_size(path, pieces, unit, scale, limits)
    bodies, cavities = closed_bodies(meshes, repairs), None
    if bodies:
        found, cavities = assembled(bodies, repairs)
    else:
        found = {BODY: _rebuild(path, tidied(concatenated(pieces), []), limits, repairs)}
    for name in own.parts:
        if name not in found:
            message = f"has no part '{name}'; its parts: {', '.join(found)}"
            raise InputError(path, "", message)
    colours = joined([piece.triangles for piece in pieces], face_colours, limits.colour_cells)
    material = colours.material()
    parts = tuple(
        Part(name, solid, material or GREY, role=own.parts.get(name))
        for name, solid in found.items()
    )
    check_volume(path, sum(part.solid.volume() for part in parts), pieces, limits)
    if cavities is not None and own.shell_thickness_m is not None:
        message = (
            "shell_thickness_m is for meshes of the outside only, but this mesh has a cavity and "
            "thus walls of its own: leave it out"
        )
        raise InputError(path, "", message)
    # With a given mass any density will do: the inertia is scaled to the mass.
    density = own.density_kg_m3 or 1e3
    model = ObjectModel(
        parts, density, own.shell_thickness_m, cavities, None if material else colours
    )
    repairs = list(dict.fromkeys(repairs))
    for repair in repairs:
        LOGGER.warning("%s: %s", path, repair)
    return ImportedModel(model, scale, own.mass_kg, tuple(repairs))


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
