"""Faces of any number of corners, as mesh files state them, and their triangles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from grasptypes.objects.solids import plane_triangles
from grasptypes.objects.surface_colours import FaceColours

# Rounding of coordinates in files stays below this share of a face's area.
AREA_TOLERANCE = 1e-4
# Faces that depart from their plane by a larger share of their extent are mentioned.
FLATNESS = 0.05

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class PolygonMesh:
    """A mesh whose faces may be concave, and have holes that a double edge joins to the outline.

    Attributes:
        vertices: (V, 3) in the file's unit.
        corners: (C,) vertex indices of all faces, one face after the other.
        sizes: (F,) number of corners of each face, at least 3.
        colours: of the faces; None if the file has none.
    """

    vertices: Array
    corners: Indices
    sizes: Indices
    colours: FaceColours | None = None

    def triangles(self) -> tuple[Indices, list[str]]:
        """Triangles in the order of the faces, and remarks about doubtful faces.

        They are (T, 3) indices into `corners`; a face with N corners has N - 2. Every edge of a
        face remains an edge of a triangle, so that closed meshes stay closed.
        """
        starts = np.cumsum(self.sizes) - self.sizes
        triangles, owners, crossing, bent = [], [], 0, 0
        for size in np.unique(self.sizes):
            which = np.flatnonzero(self.sizes == size)
            corners = starts[which][:, None] + np.arange(size)
            cut = _fan(corners)
            if size > 3:
                points = self.vertices[self.corners[corners]]
                offsets = points - points[:, :1]
                normals = np.cross(offsets, np.roll(offsets, -1, axis=1)).sum(axis=1)
                bent += int(_are_bent(points, normals).sum())
                for face in np.flatnonzero(~_fan_fits(_fan(points), normals)):
                    local, whole = _cut(points[face], normals[face])
                    cut[face] = corners[face][local]
                    crossing += not whole
            triangles.append(cut.reshape(-1, 3))
            owners.append(np.repeat(which, size - 2))
        if not triangles:
            return np.empty((0, 3), dtype=np.int64), []
        remarks = [f"cut {crossing} faces that cross themselves"] if crossing else []
        remarks += [f"cut {bent} faces that are not flat"] if bent else []
        order = np.argsort(np.concatenate(owners), kind="stable")
        return np.concatenate(triangles)[order], remarks


def _fan(corners: NDArray[Any]) -> NDArray[Any]:
    """Triangles (F, N - 2, 3, ...) from the first corner of faces (F, N, ...) to the others."""
    first = np.broadcast_to(corners[:, :1], corners[:, 2:].shape)
    return np.stack([first, corners[:, 1:-1], corners[:, 2:]], axis=2)


def _fan_fits(triangles: Array, normals: Array) -> NDArray[np.bool_]:
    """Whether all triangles (F, T, 3, 3) point the way of their face's normal (F, 3)."""
    edges = triangles[:, :, 1:] - triangles[:, :, :1]
    sides = np.cross(edges[:, :, 0], edges[:, :, 1])
    return np.asarray((np.einsum("fti,fi->ft", sides, normals) > 0).all(axis=1))


def _are_bent(points: Array, normals: Array) -> NDArray[np.bool_]:
    """Whether corners (F, N, 3) lie off the plane with the face's normal (F, 3)."""
    offsets = points - points.mean(axis=1, keepdims=True)
    lengths = np.linalg.norm(normals, axis=1) + np.finfo(float).tiny
    departure = np.abs(np.einsum("fni,fi->fn", offsets, normals)).max(axis=1) / lengths
    return np.asarray(departure > FLATNESS * np.ptp(points, axis=1).max(axis=1))


def _cut(points: Array, normal: Array) -> tuple[Indices, bool]:
    """Triangles (N - 2, 3) of one face's corners (N, 3), and whether they cover it once.

    The normal's length is twice the face's area.
    """
    fan, length = _fan(np.arange(len(points))[None])[0], np.linalg.norm(normal)
    if length == 0:  # all corners on a line
        return fan, True
    local = plane_triangles(points - points.mean(axis=0))
    if len(local) != len(fan):
        return fan, False
    edges = points[local[:, 1:]] - points[local[:, :1]]
    sides = np.cross(edges[:, 0], edges[:, 1]) @ (normal / length)
    return local, bool(abs(np.abs(sides).sum() - length) <= AREA_TOLERANCE * length)
