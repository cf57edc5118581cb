"""Watertight solids (metres) from revolved, extruded, swept and lofted sections, on manifold3d."""

from collections.abc import Sequence

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold, Mesh64, triangulate
from numpy.typing import ArrayLike, NDArray

from grasptypes.objects import sections

Array = NDArray[np.float64]

# Rotations in degrees (about x, then y) that carry +z onto the named axis.
_FROM_Z = {
    "x": (0.0, 90.0, 0.0),
    "-x": (0.0, -90.0, 0.0),
    "y": (-90.0, 0.0, 0.0),
    "-y": (90.0, 0.0, 0.0),
    "z": (0.0, 0.0, 0.0),
    "-z": (180.0, 0.0, 0.0),
}


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


def revolve(profile: ArrayLike, axis: str = "z", segments: int = 96) -> Manifold:
    """Revolve a closed (N, 2) polygon of (radius, height) about an axis through the origin."""
    polygon = np.asarray(profile, dtype=np.float64)
    return along(CrossSection([polygon], FillRule.NonZero).revolve(segments), axis)


def extrude(
    polygon: ArrayLike,
    height_m: float,
    axis: str = "z",
    centred: bool = True,
    holes: Sequence[ArrayLike] = (),
) -> Manifold:
    """Extrude a (N, 2) polygon along an axis, minus the polygons in `holes`.

    Along z the polygon's axes are x and y; see `along` for the others.
    """
    section = CrossSection([np.asarray(polygon, dtype=np.float64)], FillRule.NonZero)
    for hole in holes:
        section -= CrossSection([np.asarray(hole, dtype=np.float64)], FillRule.NonZero)
    solid = section.extrude(height_m)
    if centred:
        solid = solid.translate((0.0, 0.0, -height_m / 2))
    return along(solid, axis)


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
        path: (K, 3) points in metres; smooth it first with `sections.smooth_curve`.
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


def sphere(radius_m: float, segments: int = 64) -> Manifold:
    """Make a sphere centred on the origin."""
    return Manifold.sphere(radius_m, segments)


def cylinder(
    radius_m: float,
    height_m: float,
    axis: str = "z",
    top_radius_m: float | None = None,
    segments: int = 64,
) -> Manifold:
    """Make a cylinder or cone centred on the origin."""
    top = radius_m if top_radius_m is None else top_radius_m
    return along(Manifold.cylinder(height_m, radius_m, top, segments, True), axis)


def torus(ring_radius_m: float, tube_radius_m: float) -> Manifold:
    """Make a torus around z, centred on the origin."""
    return revolve(sections.circle(tube_radius_m, 32) + [ring_radius_m, 0.0])


def union(*solids: Manifold) -> Manifold:
    """Join solids."""
    return sum(solids[1:], start=solids[0])


def difference(solid: Manifold, *cutters: Manifold) -> Manifold:
    """Subtract all cutters from a solid."""
    return solid - union(*cutters)


def slabs(solid: Manifold, cuts_m: Sequence[float], axis: str = "z") -> list[Manifold]:
    """Cut a solid at increasing positions along x, y or z; returns the slices from low to high.

    Do not tilt the slices: only cuts at exactly the same height vanish in their union.
    """
    normal = tuple(float(name == axis) for name in "xyz")
    slices = []
    for cut in cuts_m:
        solid, below = solid.split_by_plane(normal, cut)
        slices.append(below)
    return [*slices, solid]


def along(solid: Manifold, axis: str) -> Manifold:
    """Turn a solid built along +z onto an axis: x, y, z or -x, -y, -z.

    x maps (x, y, z) to (z, y, -x); y maps it to (x, z, -y).
    """
    return solid.rotate(_FROM_Z[axis])


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
