"""Evidence for the tasks' weights of roles: which part the published hand poses touch most.

A pose is replayed on its object; the points of the hand's surface that are close to the object are
its contact. The part comes from our model, and its role is what counts.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.contact_maps.hold import GRIP_OF_TYPE
from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand
from grasptypes.hands.surface import surface_points
from grasptypes.labels.replay import read_reference_mesh
from grasptypes.objects.distance_grid import signed_distance
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.settings.holds import TouchSettings

TOUCH_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        "grip": pa.Column(str, pa.Check.isin(sorted(set(GRIP_OF_TYPE.values())))),
        "role": pa.Column(str),
        "n": pa.Column(int, pa.Check.ge(1)),
    },
    strict=True,
    unique=["object", "task", "grip", "role"],
)


class RolePoints(NamedTuple):
    """Points (N, 3) m on our object, with the role of the part they are on, (N,)."""

    points_m: NDArray[np.float64]
    roles: NDArray[np.str_]


def touched_roles(
    grasps: pd.DataFrame,
    hand: Hand,
    geometry: ObjectGeometry,
    scan: Path,
    scale: float,
    settings: TouchSettings,
) -> pd.DataFrame:
    """How many published grasps of one object touch each role most: a table of `TOUCH_SCHEMA`.

    Args:
        grasps: rows of `published.read_published` with a configuration and a valid label.
        hand: the hand of their poses.
        geometry: our model, at the grasped scale.
        scan: mesh of the real object at scale 1; if there is none, our model is used.
    """
    surface, known = geometry.surface, geometry.properties.roles
    mesh = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
    origin_m = _standing_origin(mesh)
    of_part = np.array([known[str(name)]["role"] for name in surface.part_names])
    ours = RolePoints(surface.vertices - origin_m, of_part[surface.part_index])
    mesh.apply_translation(-origin_m)
    if scan.is_file():
        mesh = read_reference_mesh(scan, scale)
    table = grasps[["object", "task"]].assign(
        grip=grasps.grasp_type.map(GRIP_OF_TYPE),
        role=[
            _touched_role(numbers, hand, mesh, ours, settings)
            for numbers in grasps.hand_configuration
        ],
    )
    keys = ["object", "task", "grip", "role"]
    return table.groupby(keys, sort=True).size().rename("n").reset_index()


def _touched_role(
    numbers: NDArray[np.float64],
    hand: Hand,
    mesh: trimesh.Trimesh,
    ours: RolePoints,
    settings: TouchSettings,
) -> str:
    """The role with the largest share of a pose's contact; the object is in the pose's frame."""
    posed = configuration.unpack(numbers)
    poses = posed.T_object_hand @ hand.link_poses(hand.couple(posed.dofs))
    surface = surface_points(hand, settings.hand_spacing_m)
    T = poses[surface.link_index]
    points = np.einsum("pij,pj->pi", T[:, :3, :3], surface.points_m) + T[:, :3, 3]
    distance_m = signed_distance(points, mesh.vertices, mesh.faces)
    # A pose that touches nothing counts for what it is closest to.
    near_m = max(settings.touch_m, distance_m.min() + settings.touch_m / 2)
    nearest = cKDTree(ours.points_m).query(points[distance_m < near_m])[1]
    roles, counts = np.unique(ours.roles[nearest], return_counts=True)
    return str(roles[np.argmax(counts)])


def _standing_origin(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    """Origin (3,) of the frame of the published poses: on the ground below the object's centre."""
    low, high = mesh.bounds
    return np.array([*(low[:2] + high[:2]) / 2, low[2]])
