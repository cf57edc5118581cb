"""The true roles of the points of an object's surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.kinds.catalogue import build
from grasptypes.objects.object_files import Surface
from grasptypes.objects.preparation import part_surface, scaled_parts
from grasptypes.settings.objects import Resolution
from grasptypes.settings.roles import PartRole, read_roles

Array = NDArray[np.float64]

# Weight of a difference between normals against metres: the other side of a wall is far away.
NORMAL_M = 0.003


@dataclass(frozen=True)
class TrueRoles:
    """Points on an object with known roles.

    Attributes:
        points_m, normals: (N, 3) in the object's frame.
        roles: (N,) role of each point.
    """

    points_m: Array
    normals: Array
    roles: Sequence[PartRole]

    @classmethod
    def of_surface(cls, surface: Surface, roles: Sequence[PartRole]) -> TrueRoles:
        """The vertices of a surface.

        Args:
            roles: (V,) role of each vertex.
        """
        mesh = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
        return cls(surface.vertices, mesh.vertex_normals, roles)

    @classmethod
    def of_model(cls, name: str, scale: float, resolution: Resolution) -> TrueRoles:
        """The points of our own model of one of the 19 objects."""
        models = scaled_parts(build(name), scale)
        surface = part_surface(models, resolution.surface_tolerance_m, resolution.surface_edge_m)
        role_of = {part.name: part.role for part in models if part.role}
        names = [str(surface.part_names[index]) for index in surface.part_index]
        return cls.of_surface(surface, [role_of[name] for name in names])

    def at(self, points_m: Array, normals: Array) -> list[PartRole]:
        """Role (n,) of points near the object: of the nearest of these that faces the same way.

        Args:
            points_m, normals: (n, 3); normals point out of the object.
        """
        tree = cKDTree(np.hstack([self.points_m, NORMAL_M * self.normals]))
        nearest = tree.query(np.hstack([points_m, NORMAL_M * normals]))[1]
        return [self.roles[int(index)] for index in nearest]

    def index_at(self, points_m: Array, normals: Array) -> NDArray[np.intp]:
        """The same roles (n,) as their places in roles.yaml."""
        order = list(read_roles().roles)
        return np.array([order.index(part.role) for part in self.at(points_m, normals)])
