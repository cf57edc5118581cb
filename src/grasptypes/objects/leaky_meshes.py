"""Solids of meshes with holes: the surface of what a mesh encloses, by its winding number."""

from __future__ import annotations

from pathlib import Path

import igl
import numpy as np
import trimesh
from manifold3d import Manifold
from numpy.typing import NDArray
from scipy import ndimage

from grasptypes.errors import InputError
from grasptypes.objects import solids
from grasptypes.settings.objects import ImportLimits

Array = NDArray[np.float64]

# Far from the surface the winding number changes slowly: every fourth node tells enough.
STRIDE = 4
# Near the surface, every fourth diagonal layer: each wall, however thin, has nodes in it.
DIAGONAL = 4
# Random points on the surface for each square of the grid: next to no cell of the surface has none.
POINTS_PER_SQUARE = 4
# The new surface has triangles in every cell. Where it is flat to this share of the spacing, larger
# ones will do, in whose number most of the later time goes.
FLAT = 0.05
# Winding numbers are found up to twice as fast if no edge is longer than this many cells: the boxes
# around long faces overlap.
EDGE_CELLS = 8
# Nodes nearer than this share of the spacing count as on a face.
ON_FACE = 0.001


def rebuilt(
    path: str | Path, mesh: trimesh.Trimesh, limits: ImportLimits
) -> tuple[Manifold, float]:
    """The volume that a leaky mesh encloses, and the spacing of the grid that it was found on.

    Raises:
        InputError: the mesh encloses too little, or what it encloses has no proper surface.
    """
    spacing = float(mesh.extents.max()) / limits.rebuild_cells
    origin = mesh.bounds[0] - 3 * spacing
    shape = np.ceil((mesh.bounds[1] - origin) / spacing).astype(int) + 4
    vertices = np.ascontiguousarray(mesh.vertices, dtype=np.float64)
    faces = np.ascontiguousarray(mesh.faces, dtype=np.int64)
    bits = _bisected(vertices[faces], EDGE_CELLS * spacing).reshape(-1, 3)
    corners = np.arange(len(bits)).reshape(-1, 3)

    def places(chosen: NDArray[np.bool_]) -> Array:
        """Positions (n, 3) of the chosen nodes."""
        return np.ascontiguousarray(np.argwhere(chosen) * spacing + origin)

    def winding_at(chosen: NDArray[np.bool_]) -> Array:
        """Winding numbers (n,) of the mesh at the chosen nodes, whichever way its faces face."""
        return np.asarray(np.abs(igl.fast_winding_number(bits, corners, places(chosen))))

    def distance_at(chosen: NDArray[np.bool_]) -> Array:
        """Distances (n,) of the chosen nodes to the mesh."""
        squared = igl.point_mesh_squared_distance(places(chosen), vertices, faces)[0]
        return np.asarray(np.sqrt(squared))

    known = _near_surface(mesh, origin, spacing, shape)
    known &= sum(np.indices(shape, sparse=True)) % DIAGONAL == 0
    known[::STRIDE, ::STRIDE, ::STRIDE] = True
    winding = np.zeros(shape)
    winding[known] = winding_at(known)
    # From the nearest node that is known. The surface is farther away, except in a hole.
    nearest = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
    winding = winding[tuple(nearest)]
    while (unknown := _beside_change(winding > 0.5) & ~known).any():
        winding[unknown] = winding_at(unknown)
        known |= unknown
    between = (winding > 0.25) & (winding < 0.75)
    # A node on a face has one half there, whether or not there are holes.
    unsure = int((distance_at(between) > ON_FACE * spacing).sum())
    _check_volume(path, winding, unsure, limits)
    # What bulges out of a hole ends at the bounds of the mesh, four nodes inside the grid's.
    winding *= np.pad(np.ones(shape - 8), 4)
    # Only the distances of nodes beside the new surface say where it is.
    beside = _beside_change(winding > 0.5)
    distances = np.full(shape, spacing)
    distances[beside] = distance_at(beside)
    values = np.where(winding > 0.5, -distances, distances)
    try:
        solid = _marched(values, places(np.ones(shape, dtype=bool)))
    except ValueError as error:
        raise InputError(path, "", "has holes, and its surface cannot be rebuilt") from error
    return solid.simplify(FLAT * spacing), spacing


def _check_volume(path: str | Path, winding: Array, unsure: int, limits: ImportLimits) -> None:
    """Refuse an open shell, where many nodes are neither inside nor outside, and a flat mesh."""
    enclosed = int((winding >= 0.75).sum())
    if unsure > limits.max_open_share * enclosed:
        raise InputError(
            path, "", "is an open shell without volume: close its holes or give its walls thickness"
        )
    if not (winding > 0.5).any():
        raise InputError(path, "", "encloses no volume: it is flat")


def _bisected(triangles: Array, edge: float) -> Array:
    """Triangles (F, 3, 3), cut in the middle of their longest edges until none is longer."""
    done = []
    while len(triangles):
        lengths = np.linalg.norm(np.roll(triangles, -1, axis=1) - triangles, axis=2)
        long = lengths.max(axis=1) > edge
        done.append(triangles[~long])
        order = (lengths[long].argmax(axis=1)[:, None] + np.arange(3)) % 3
        start, end, tip = np.moveaxis(
            np.take_along_axis(triangles[long], order[..., None], axis=1), 1, 0
        )
        middle = (start + end) / 2
        triangles = np.stack([start, middle, tip, middle, end, tip], axis=1).reshape(-1, 3, 3)
    return np.concatenate(done)


def _near_surface(
    mesh: trimesh.Trimesh, origin: Array, spacing: float, shape: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """The nodes of the cells that a surface passes through."""
    count = int(POINTS_PER_SQUARE * mesh.area / spacing**2) + 1
    points = trimesh.sample.sample_surface(mesh, count, seed=0)[0]
    near = np.zeros(shape, dtype=bool)
    near[tuple(((points - origin) / spacing).astype(int).T)] = True
    # The nodes of a cell are its own and the next along each axis.
    return np.asarray(ndimage.binary_dilation(near, np.ones((2, 2, 2)), origin=-1))


def _beside_change(inside: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The nodes with a neighbour, along an axis, on the other side."""
    beside = np.zeros_like(inside)
    for axis in range(3):
        changes = np.moveaxis(np.diff(inside, axis=axis), axis, 0)
        along = np.moveaxis(beside, axis, 0)
        along[:-1] |= changes
        along[1:] |= changes
    return beside


def _marched(values: Array, nodes: Array) -> Manifold:
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
