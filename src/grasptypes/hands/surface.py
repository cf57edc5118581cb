"""A hand's surface: closed meshes and evenly spread points, link by link."""

import re
from functools import cache
from typing import NamedTuple

import manifold3d
import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.hands.hand import Hand
from grasptypes.hands.links import Link
from grasptypes.seeds import rng

Array = NDArray[np.float64]

# About 25 candidates per disc of the chosen spacing, so that a disc is rarely empty.
CANDIDATES_PER_DISC = 25


class SurfacePoints(NamedTuple):
    """Points spread evenly over the hand's surface, each in the frame of its link.

    A point is posed by `T_hand_link[link_index] @ point`.
    """

    link_index: NDArray[np.int64]
    """(n,) index into `Hand.links`, ascending."""
    points_m: Array
    """(n, 3) metres."""
    normals: Array
    """(n, 3) unit vectors out of the link."""


@cache
def link_meshes(hand: Hand) -> tuple[trimesh.Trimesh, ...]:
    """A closed mesh of each link, metres: the union of its convex parts."""
    return tuple(_united(link) for link in hand.links)


def _united(link: Link) -> trimesh.Trimesh:
    solids = [manifold3d.Manifold.hull_points(part.vertices_m) for part in link.parts]
    mesh = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add).to_mesh64()
    return trimesh.Trimesh(mesh.vert_properties[:, :3], mesh.tri_verts, process=True)


@cache
def link_shapes(hand: Hand) -> tuple[int, ...]:
    """For each link, the index of the first one of the same shape."""
    shapes = [tuple(part.vertices_m.tobytes() for part in link.parts) for link in hand.links]
    return tuple(map(shapes.index, shapes))


@cache
def surface_points(hand: Hand, spacing_m: float) -> SurfacePoints:
    """Points on the surface of all links, no two of a link closer than `spacing_m`.

    Points inside the hubs that a neighbouring link covers at every joint angle are left out, since
    nothing can touch them. The result depends on the hand and the spacing only.
    """
    links, points, normals = [], [], []
    for index, link in enumerate(hand.links):
        # Fingers of one shape carry the same points: their links' names differ in a number.
        kind = re.sub(r"_\d+$", "", link.name)
        point, normal = _spread(hand, link_shapes(hand)[index], kind, spacing_m)
        seen = ~_always_covered(hand, index, point)
        links.append(np.full(seen.sum(), index))
        points.append(point[seen])
        normals.append(normal[seen])
    return SurfacePoints(np.concatenate(links), np.concatenate(points), np.concatenate(normals))


@cache
def _spread(hand: Hand, link: int, kind: str, spacing_m: float) -> tuple[Array, Array]:
    """Poisson-disc points and normals of one link: (n, 3), (n, 3); drawn by its kind."""
    mesh = link_meshes(hand)[link]
    count = int(CANDIDATES_PER_DISC * mesh.area / spacing_m**2)
    seed = int(rng("hand_surface", kind).integers(2**31))
    candidates, faces = trimesh.sample.sample_surface(mesh, count, seed=seed)
    free = np.ones(count, dtype=bool)
    kept = []
    tree = cKDTree(candidates)
    for candidate in range(count):
        if free[candidate]:
            kept.append(candidate)
            free[tree.query_ball_point(candidates[candidate], spacing_m)] = False
    return np.asarray(candidates)[kept], mesh.face_normals[faces[kept]]


def _always_covered(hand: Hand, link: int, points: Array) -> NDArray[np.bool_]:
    """Which points (n, 3) of a link lie inside its neighbours over the whole range of the joint."""
    lower, upper = hand.joint_limits.T
    poses = hand.link_poses(np.linspace(lower, upper, 5))
    covered = np.zeros(len(points), dtype=bool)
    for index, joint in enumerate(hand.joints):
        ends = [joint.parent, index + 1]
        if link in ends:
            other = ends[1 - ends.index(link)]
            T_other_link = np.linalg.inv(poses[:, other]) @ poses[:, link]
            inside = [
                inside_link(hand.links[other], points @ T[:3, :3].T + T[:3, 3])
                for T in T_other_link
            ]
            covered |= np.all(inside, axis=0)
    return covered


@cache
def _half_spaces(link: Link) -> tuple[tuple[Array, Array], ...]:
    hulls = [trimesh.Trimesh(part.vertices_m, part.faces) for part in link.parts]
    return tuple(
        (hull.face_normals, np.einsum("fi,fi->f", hull.face_normals, hull.triangles[:, 0]))
        for hull in hulls
    )


def depth_in_link(link: Link, points: Array) -> Array:
    """How deep points (n, 3) of a link's frame lie in its deepest convex part.

    Returns:
        (n,) metres, positive inside; outside, the negative of a lower bound on the distance.
    """
    depths = [(offset - points @ normal.T).min(axis=1) for normal, offset in _half_spaces(link)]
    return np.asarray(np.max(depths, axis=0))


def depth_in_hand(hand: Hand, points: Array, link_poses: Array) -> float:
    """How deep the deepest of points (n, 3) lies in a hand, metres, 0 if all are outside.

    Args:
        link_poses: (L, 4, 4) in the points' frame.
    """
    depth = 0.0
    for link, mesh, T in zip(hand.links, link_meshes(hand), link_poses, strict=True):
        in_link = (points - T[:3, 3]) @ T[:3, :3]
        lower, upper = mesh.bounds
        near = in_link[((in_link > lower) & (in_link < upper)).all(axis=1)]
        depth = max(depth, float(depth_in_link(link, near).max(initial=0.0)))
    return depth


def inside_link(link: Link, points: Array) -> NDArray[np.bool_]:
    """Which points (n, 3), metres in the frame of a link, lie inside it."""
    return depth_in_link(link, points) > 0.0
