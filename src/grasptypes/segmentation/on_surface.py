"""Parts that are known at points, carried over to a meshed surface."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.contact_maps.placement import SurfacePoints
from grasptypes.objects.object_files import Surface
from grasptypes.segmentation.parts import Parts

Array = NDArray[np.float64]

# Weight of a difference between normals against metres: points on the other side of a wall are far
# away.
NORMAL_M = 0.01


def role_of(parts: Parts) -> Mapping[str, str]:
    """Name of the role of each part by name; empty without one."""
    return {name: part.role if part else "" for name, part in parts.roles.items()}


def with_parts(surface: Surface, points: SurfacePoints, parts: Parts) -> Surface:
    """The surface with these parts at its vertices instead of its own.

    Args:
        points: to which `parts` belong.
    """
    mesh = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
    index = _nearest(points, parts.part_index, surface.vertices, mesh.vertex_normals)
    return replace(surface, part_index=index, part_names=np.array(list(parts.roles)))


def face_parts(
    surface: Surface, points: SurfacePoints, part_index: NDArray[np.int16]
) -> NDArray[np.int16]:
    """Part (F,) of each face of a surface."""
    corners = surface.vertices[surface.faces]
    return _nearest(points, part_index, corners.mean(axis=1), face_normals(corners))


def face_normals(corners: Array) -> Array:
    """Unit normals (F, 3) of faces with corners (F, 3, 3); zero where a face has no area."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30))


def _nearest(
    points: SurfacePoints, part_index: NDArray[np.int16], at_m: Array, normals: Array
) -> NDArray[np.int16]:
    """Part of the nearest point (N,) that faces the same way, at other points."""
    tree = cKDTree(np.hstack([points.points_m, NORMAL_M * points.normals]))
    return np.asarray(part_index[tree.query(np.hstack([at_m, NORMAL_M * normals]))[1]])
