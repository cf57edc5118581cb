"""The true roles of the points of an object's surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.errors import InputError, parsing
from grasptypes.kinds.catalogue import build
from grasptypes.objects.object_files import Surface
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.objects.preparation import part_surface, scaled_parts
from grasptypes.settings.objects import Resolution
from grasptypes.settings.roles import PartRole, read_roles

Array = NDArray[np.float64]

# Weight of a difference between normals against metres: the other side of a wall is far away.
NORMAL_M = 0.003


AXES = ("x", "y", "z")
SLICE_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "role": pa.Column(str),
        "attributes": pa.Column(str, description="separated by semicolons"),
        "axis": pa.Column(str, pa.Check.isin(AXES), description="of the object's frame"),
        "from_m": pa.Column(float, nullable=True, description="open if it is left out"),
        "to_m": pa.Column(float, nullable=True),
    },
    strict=True,
    ordered=True,
)


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

    @classmethod
    def of_slices(cls, surface: Surface, slices: pd.DataFrame) -> TrueRoles:
        """The vertices of a surface that somebody has cut into slices with roles.

        Args:
            slices: rows of `SLICE_SCHEMA` about one object, of which the first that holds counts.
        """
        left = np.ones(len(surface.vertices), dtype=bool)
        roles: dict[int, PartRole] = {}
        for row in slices.itertuples():
            along = surface.vertices[:, AXES.index(row.axis)]
            inside = left & ~(along < row.from_m) & ~(along > row.to_m)
            words = row.attributes.split(";") if row.attributes else []
            role = PartRole.check({"role": row.role, "attributes": words})
            roles |= dict.fromkeys(np.flatnonzero(inside).tolist(), role)
            left &= ~inside
        if left.any():
            name = str(slices.object.iloc[0])
            raise InputError("slices", name, f"{left.mean():.0%} of its surface is in none")
        return cls.of_surface(surface, [roles[vertex] for vertex in range(len(left))])

    def at(self, points_m: Array, normals: Array) -> list[PartRole]:
        """Role (n,) of points near the object: of the nearest of these that faces the same way.

        Args:
            points_m, normals: (n, 3); normals point out of the object.
        """
        nearest = nearest_facing(self.points_m, self.normals, points_m, normals)
        return [self.roles[int(index)] for index in nearest]

    def index_at(self, points_m: Array, normals: Array) -> NDArray[np.intp]:
        """The same roles (n,) as their places in roles.yaml."""
        order = list(read_roles().roles)
        return np.array([order.index(part.role) for part in self.at(points_m, normals)])


def nearest_facing(
    known_m: Array, known_normals: Array, points_m: Array, normals: Array
) -> NDArray[np.intp]:
    """Index (n,) of the nearest of known points (N, 3) that faces the same way as each point (n, 3)
    near the object."""
    tree = cKDTree(np.hstack([known_m, NORMAL_M * known_normals]))
    nearest: NDArray[np.intp] = tree.query(np.hstack([points_m, NORMAL_M * normals]))[1]
    return nearest


def read_slices(path: str | Path) -> pd.DataFrame:
    """The slices of objects whose roles somebody has read off their meshes, see `SLICE_SCHEMA`.

    Raises:
        InputError: names the file, and the first column that is wrong.
    """
    with parsing(path, "cannot be read as CSV"):
        table = pd.read_csv(path, comment="#")
        return SLICE_SCHEMA.validate(table.fillna({"attributes": ""}))


def true_roles(
    geometry: ObjectGeometry, slices: pd.DataFrame, scale: float, resolution: Resolution
) -> TrueRoles:
    """The true roles of a scan: those of its slices, else those of our model with its name.

    Args:
        scale: of the scan.
    """
    own = slices[slices.object == geometry.name]
    if len(own):
        return TrueRoles.of_slices(geometry.surface, own)
    return TrueRoles.of_model(geometry.name, scale, resolution)
