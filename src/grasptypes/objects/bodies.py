"""Closed surfaces of a mesh file, and the solids and cavities that they bound."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import cast

import igl
import numpy as np
import trimesh
from manifold3d import Manifold, Mesh64
from numpy.typing import NDArray

from grasptypes.objects import solids

BODY = "body"
# The pieces, in which a file states it, of each mesh by name.
Meshes = Mapping[str, Sequence[trimesh.Trimesh]]


@dataclass(frozen=True)
class Body:
    """What one closed surface bounds.

    Attributes:
        name: the mesh that it belongs to.
        mesh: the surface, oriented outwards.
        solid: the space inside it.
        inward: whether the file orients it inwards, as the surface of a cavity.
    """

    name: str
    mesh: trimesh.Trimesh
    solid: Manifold
    inward: bool


def closed_bodies(meshes: Meshes, repairs: list[str]) -> list[Body] | None:
    """Split meshes into bodies, mended where necessary; None if one of them is not closed.

    Bodies that touch are closed only apart, and surfaces that the file cuts, for example by
    material, are closed only together.
    """
    named = {name: [concatenated(pieces)] for name, pieces in meshes.items()}
    whole = {BODY: [concatenated([pieces[0] for pieces in named.values()])]}
    # A face without area may close a seam, so these are only dropped if necessary.
    ways = (
        (_merged, meshes), (_as_stated, meshes), (_merged, named), (_merged, whole),
        (tidied, named), (tidied, whole),
    )  # fmt: skip
    for filling in (False, True):
        for prepared, groups in ways:
            done: list[str] = []
            if groups is whole and len(meshes) > 1:
                done.append("joined parts that are closed only together")
            bodies = _bodies(
                ((name, prepared(mesh, done)) for name, some in groups.items() for mesh in some),
                filling,
                done,
            )
            if bodies:
                repairs += done
                return bodies
    return None


def _bodies(
    meshes: Iterable[tuple[str, trimesh.Trimesh]], filling: bool, repairs: list[str]
) -> list[Body]:
    """The bodies of named meshes; empty if one of them is not closed."""
    bodies = []
    for name, mesh in meshes:
        for part in _split(mesh):
            body = _body(name, part, filling, repairs)
            if body is None:
                return []
            bodies.append(body)
    return bodies


def _split(mesh: trimesh.Trimesh) -> Iterator[trimesh.Trimesh]:
    """The connected pieces of a mesh, made one, two, four at a time: who stops early saves time."""
    numbers = np.arange(len(mesh.faces))
    pieces = trimesh.graph.connected_components(mesh.face_adjacency, nodes=numbers, min_len=1)
    first = 0
    while first < len(pieces):
        yield from cast(Sequence[trimesh.Trimesh], mesh.submesh(pieces[first : 2 * first + 1]))
        first = 2 * first + 1


def _as_stated(mesh: trimesh.Trimesh, _: list[str]) -> trimesh.Trimesh:
    return mesh


def _merged(mesh: trimesh.Trimesh, _: list[str]) -> trimesh.Trimesh:
    """Merge equal vertices."""
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=True)


def tidied(mesh: trimesh.Trimesh, repairs: list[str]) -> trimesh.Trimesh:
    """Merge equal vertices and drop faces that have no area or are duplicates."""
    mesh = _merged(mesh, [])
    before = len(mesh.faces)
    mesh.update_faces(mesh.nondegenerate_faces() & mesh.unique_faces())
    mesh.remove_unreferenced_vertices()
    if len(mesh.faces) < before:
        repairs.append(f"dropped {before - len(mesh.faces)} degenerate or double faces")
    return mesh


def concatenated(meshes: Sequence[trimesh.Trimesh]) -> trimesh.Trimesh:
    """All meshes in one."""
    return cast(trimesh.Trimesh, trimesh.util.concatenate(meshes))


def _body(name: str, mesh: trimesh.Trimesh, filling: bool, repairs: list[str]) -> Body | None:
    """Close, if `filling`, and orient one surface; None if it stays open."""
    if filling and not mesh.is_watertight and mesh.fill_holes():
        repairs.append("filled small holes")
    if _is_open(mesh):
        return None
    if not mesh.is_winding_consistent:
        before, areas = mesh.face_normals.copy(), mesh.area_faces
        mesh.faces = igl.bfs_orient(np.ascontiguousarray(mesh.faces, dtype=np.int64))[0]
        # Most of the surface keeps its side.
        if areas @ np.einsum("fi,fi->f", before, mesh.face_normals) < 0:
            mesh.invert()
        repairs.append("turned faces outwards")
    # Six times the volume.
    inward = bool(np.linalg.det(mesh.triangles - mesh.bounds[0]).sum() < 0)
    if inward:
        mesh.invert()
    solid = Manifold(
        Mesh64(
            np.ascontiguousarray(mesh.vertices, dtype=np.float64),
            np.ascontiguousarray(mesh.faces, dtype=np.uint64),
        )
    )
    return None if solid.is_empty() else Body(name, mesh, solid, inward)


def _is_open(mesh: trimesh.Trimesh) -> bool:
    """Whether an edge has an odd number of faces, so that turning faces does not close it."""
    faces_at_edge = np.bincount(mesh.edges_unique_inverse)
    start, end = mesh.edges_unique.T
    return bool((faces_at_edge[start != end] % 2).any())


def assembled(
    bodies: Sequence[Body], repairs: list[str]
) -> tuple[Mapping[str, Manifold], Manifold | None]:
    """Solids by name, without regard to what is inside them, and the cavities inside (or None).

    A surface oriented inwards inside another one bounds a cavity. Outermost surfaces are turned
    outwards, and with them everything inside. Solids within solids, and within cavities, are
    material; the space between surfaces is empty where their orientations add up to zero.
    """
    within = _nesting(bodies)
    turned = np.array([body.inward for body in bodies]) & ~within.any(axis=1)
    if turned.any():
        repairs.append("turned faces outwards")
    signs = np.array([-1 if body.inward else 1 for body in bodies])
    signs[turned | within[:, turned].any(axis=1)] *= -1
    winding = signs + within @ signs
    parts: dict[str, list[Manifold]] = {}
    for body, sign in zip(bodies, signs, strict=True):
        if sign > 0:
            parts.setdefault(body.name, []).append(body.solid)
    repairs += [f"joined {len(found)} bodies" for found in parts.values() if len(found) > 1]
    cavities = []
    for hole in np.flatnonzero((signs < 0) & (winding <= 0)).tolist():
        cavity = bodies[hole].solid
        for index in np.flatnonzero((signs > 0) & ~within[hole]).tolist():
            cavity -= bodies[index].solid
        cavities.append(cavity)
    joined = {name: solids.union(*found) for name, found in parts.items()}
    return joined, solids.union(*cavities) if cavities else None


def _nesting(bodies: Sequence[Body]) -> NDArray[np.bool_]:
    """(N, N): whether the body of the row lies inside that of the column."""
    lower, upper = np.array([body.mesh.bounds for body in bodies]).transpose(1, 0, 2)
    contained = (lower[:, None] > lower[None]) & (upper[:, None] < upper[None])
    within: NDArray[np.bool_] = np.asarray(contained.all(axis=2))
    for inner, outer in np.argwhere(within).tolist():
        winding = igl.fast_winding_number(
            np.ascontiguousarray(bodies[outer].mesh.vertices, dtype=np.float64),
            np.ascontiguousarray(bodies[outer].mesh.faces, dtype=np.int64),
            np.ascontiguousarray(bodies[inner].mesh.vertices, dtype=np.float64),
        )
        within[inner, outer] = (winding > 0.5).all()
    return within
