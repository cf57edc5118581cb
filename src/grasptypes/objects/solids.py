"""Watertight solids (metres) from extruded, swept and lofted sections, on manifold3d."""

from collections.abc import Sequence

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold, Mesh64, triangulate
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def from_mesh(vertices: ArrayLike, faces: ArrayLike) -> Manifold:
    """Make a solid from a closed oriented mesh.

    Args:
        vertices: (V, 3) points in metres.
        faces: (F, 3) vertex indices, counter-clockwise seen from outside.

    Raises:
        ValueError: the mesh is not a closed oriented 2-manifold.
    """
    solid = Manifold(
        Mesh64(
            np.ascontiguousarray(vertices, dtype=np.float64),
            np.ascontiguousarray(faces, dtype=np.uint64),
        )
    )
    if solid.is_empty():
        raise ValueError(f"not a closed oriented mesh: {solid.status()}")
    return solid


def to_mesh(solid: Manifold) -> tuple[Array, NDArray[np.int32]]:
    """Return a solid's vertices (V, 3) in metres and faces (F, 3)."""
    mesh = solid.to_mesh64()
    return (
        np.array(mesh.vert_properties[:, :3], dtype=np.float64),
        np.array(mesh.tri_verts, dtype=np.int32),
    )


def extrude(polygon: ArrayLike, height_m: float, holes: Sequence[ArrayLike] = ()) -> Manifold:
    """Extrude a (N, 2) polygon from z = 0, minus the polygons in `holes`."""
    section = CrossSection([np.asarray(polygon, dtype=np.float64)], FillRule.NonZero)
    for hole in holes:
        section -= CrossSection([np.asarray(hole, dtype=np.float64)], FillRule.NonZero)
    return section.extrude(height_m)


def loft(rings: Sequence[ArrayLike] | Array) -> Manifold:
    """Skin a sequence of plane rings (K, N, 3) and cap both ends.

    All rings have N points that correspond in order and run counter-clockwise seen
    against the direction of travel, so that their normals point to the next ring.
    """
    points = np.asarray(rings, dtype=np.float64)
    count, size = points.shape[:2]
    front, back = plane_triangles(points[-1]), plane_triangles(points[0])
    faces = np.vstack([_skin(count, size), front + (count - 1) * size, back[:, ::-1]])
    return from_mesh(points.reshape(-1, 3), faces)


def sweep(
    path: ArrayLike,
    section: ArrayLike | Sequence[ArrayLike],
    scales: ArrayLike | None = None,
    up: Sequence[float] = (0.0, 0.0, 1.0),
) -> Manifold:
    """Carry a section along a path.

    Args:
        path: (K, 3) points in metres; smooth it first.
        section: (N, 2) polygon, or K of them with equal N; the second axis points to `up`.
        scales: (K,) or (K, 2) factors on the section along the path.
        up: direction the section's second axis stays closest to; not along the path.
    """
    centres = np.asarray(path, dtype=np.float64)
    polygons = np.asarray(section, dtype=np.float64)
    if polygons.ndim == 2:
        polygons = np.broadcast_to(polygons, (len(centres), *polygons.shape))
    if scales is not None:
        factors = np.asarray(scales, dtype=np.float64).reshape(len(centres), -1)
        polygons = polygons * factors[:, None, :]
    right, above = _path_frames(centres, np.asarray(up, dtype=np.float64))
    rings = (
        centres[:, None] + polygons[..., :1] * right[:, None] + polygons[..., 1:] * above[:, None]
    )
    return loft(rings)


def box(size_m: Sequence[float], radius_m: float = 0.0) -> Manifold:
    """Make a box centred on the origin, its edges rounded with the given radius."""
    if radius_m <= 0:
        return Manifold.cube(tuple(size_m), True)
    half = np.asarray(size_m) / 2 - radius_m
    corners = np.array(np.meshgrid(*([-1, 1],) * 3)).reshape(3, -1).T * half
    ball = Manifold.sphere(radius_m, 24)
    return Manifold.batch_hull([ball.translate(tuple(corner)) for corner in corners])


def ellipsoid(half_axes_m: Sequence[float], segments: int = 64) -> Manifold:
    """Make an ellipsoid centred on the origin from its three half axes."""
    return Manifold.sphere(1.0, segments).scale(tuple(half_axes_m))


def union(*solids: Manifold) -> Manifold:
    """Join solids."""
    return sum(solids[1:], start=solids[0])


def _skin(count: int, size: int) -> NDArray[np.int64]:
    """Return the side triangles (2 * (count - 1) * size, 3) between rings of `size` points."""
    here = np.arange(count - 1)[:, None] * size + np.arange(size)
    right = np.arange(count - 1)[:, None] * size + (np.arange(size) + 1) % size
    lower = np.stack([here, right, right + size], axis=-1)
    upper = np.stack([here, right + size, here + size], axis=-1)
    return np.concatenate([lower, upper]).reshape(-1, 3)


def plane_triangles(ring: Array) -> NDArray[np.int64]:
    """Triangulate a plane ring (N, 3), counter-clockwise about its own (Newell) normal.

    The ring may be concave and touch itself; each of its edges is one of a triangle.
    """
    shifted = np.roll(ring, -1, axis=0)
    normal = np.cross(ring, shifted).sum(axis=0)
    right = np.cross(np.eye(3)[np.argmin(np.abs(normal))], normal)
    right /= np.linalg.norm(right)
    above = np.cross(normal / np.linalg.norm(normal), right)
    return np.asarray(triangulate([np.column_stack([ring @ right, ring @ above])]), dtype=np.int64)


def _path_frames(centres: Array, up: Array) -> tuple[Array, Array]:
    """Return unit (K, 3) right and above vectors of the sections along a path."""
    tangents = np.gradient(centres, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    right = np.cross(up, tangents)
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    return right, np.cross(tangents, right)
