"""Replay of the published hand poses on the scanned objects: a check of frames, scale, kinematics.

For each pose, with d(p) the exact signed distance (negative inside) of a point on the hand's
surface to the object's surface, and e(p) the depth of a corner of the object in the hand:

- gap = max(0, min d): 0 if hand and object touch or overlap anywhere;
- penetration = max(0, max -d, max e). It never exceeds half the thickness of the penetrated object
  or link.

The origin of the published poses' frame is below the centre of the object, where it stands on the
ground. The scans, whose own origin is the centroid of their surface, are moved to that frame first.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh
from numpy.typing import NDArray

from grasptypes.errors import InputError, parsing
from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand, beyond
from grasptypes.hands.states import HandStates
from grasptypes.hands.surface import depth_in_hand, surface_points
from grasptypes.objects.distance_grid import signed_distance
from grasptypes.settings.grasp_types import ReplaySettings

Array = NDArray[np.float64]

MM = 1e3

REPLAY_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str, unique=True),
        "n": pa.Column(int, pa.Check.ge(1)),
        "gap_median_mm": pa.Column(float, pa.Check.ge(0)),
        "gap_p90_mm": pa.Column(float, pa.Check.ge(0)),
        "penetration_median_mm": pa.Column(float, pa.Check.ge(0)),
        "beyond_limits": pa.Column(int, pa.Check.ge(0)),
    },
    strict=True,
    ordered=True,
)


class HandFit(NamedTuple):
    """Distances between hands and an object, one row per pose."""

    link_distance_m: Array
    """(n, L) smallest signed distance of each link to the object, negative inside."""
    depth_m: Array
    """(n,) depth of the object's corners in the hand, 0 or more."""

    @property
    def gap_m(self) -> Array:
        """(n,) distance between hand and object, 0 if they touch."""
        apart = np.maximum(self.link_distance_m.min(axis=1), 0.0)
        return np.where(self.depth_m > 0.0, 0.0, apart)

    @property
    def penetration_m(self) -> Array:
        """(n,) penetration depth of hand and object, 0 without penetration."""
        return np.asarray(np.maximum(-self.link_distance_m.min(axis=1), self.depth_m).clip(min=0.0))


def read_reference_mesh(path: str | Path, scale: float) -> trimesh.Trimesh:
    """A scanned object, metres, scaled and moved to the frame of the published poses.

    The axes of that frame are those of the scan, its x-y origin is the centre of the object's
    bounding box, and its x-y plane is the ground.

    Raises:
        InputError: the file is not a triangle mesh.
    """
    with parsing(path, "cannot be read as a mesh"):
        mesh = trimesh.load_mesh(path)
    if not isinstance(mesh, trimesh.Trimesh) or len(mesh.faces) == 0:
        raise InputError(path, "", "has no triangles")
    mesh.apply_scale(scale)
    lower, upper = mesh.bounds
    middle = (lower + upper) / 2.0
    mesh.apply_translation([-middle[0], -middle[1], -lower[2]])
    return mesh


def fit_hands(
    hand: Hand, configurations: Array, mesh: trimesh.Trimesh, spacing_m: float
) -> HandFit:
    """Place a hand at configurations (n, 13 + D) and measure its distance to the object.

    Fingertips are assumed to be coupled to their finger bases, since the poses contain no more.
    """
    posed = configuration.unpack(configurations)
    states = HandStates(hand, posed.T_object_hand, hand.couple(posed.dofs))
    T_object_link, surface = states.link_poses(), surface_points(hand, spacing_m)
    T_object_point = T_object_link[:, surface.link_index]
    points = np.einsum("npij,pj->npi", T_object_point[..., :3, :3], surface.points_m)
    points += T_object_point[..., :3, 3]
    distances = signed_distance(points.reshape(-1, 3), mesh.vertices, mesh.faces)
    distances = distances.reshape(len(points), -1)
    starts = np.searchsorted(surface.link_index, np.arange(len(hand.links)))
    depths = [depth_in_hand(hand, np.asarray(mesh.vertices), T) for T in T_object_link]
    return HandFit(np.minimum.reduceat(distances, starts, axis=1), np.array(depths))


def replay_object(
    name: str, hand: Hand, configurations: Array, mesh: trimesh.Trimesh, settings: ReplaySettings
) -> dict[str, str | int | float]:
    """One row of the replay table: an object's published configurations on its mesh."""
    fit = fit_hands(hand, configurations, mesh, settings.surface_spacing_m)
    dofs = configuration.unpack(configurations).dofs
    tolerance = np.where(
        hand.prismatic_dofs, settings.limit_tolerance_m, settings.limit_tolerance_rad
    )
    exceeding = beyond(dofs, hand.dof_limits, tolerance)
    return {
        "object": name,
        "n": len(configurations),
        "gap_median_mm": round(float(np.median(fit.gap_m)) * MM, 3),
        "gap_p90_mm": round(float(np.percentile(fit.gap_m, 90)) * MM, 3),
        "penetration_median_mm": round(float(np.median(fit.penetration_m)) * MM, 3),
        "beyond_limits": int(exceeding.any(axis=1).sum()),
    }


def replay(
    published: pd.DataFrame, hand: Hand, meshes: dict[str, Path], settings: ReplaySettings
) -> pd.DataFrame:
    """Replay all published poses with a configuration, for the objects with a mesh.

    Args:
        published: the table of `published.read_published`.
        hand: the hand of its poses.
        meshes: the reference mesh of each object to replay.

    Returns:
        A table that meets `REPLAY_SCHEMA`, objects in alphabetical order.

    Raises:
        InputError: a mesh cannot be read.
    """
    known = published[published.hand_configuration.notna()]
    rows = []
    for name, poses in known.groupby("object", sort=True):
        if name in meshes:
            mesh = read_reference_mesh(meshes[name], settings.object_scale)
            numbers = np.stack(poses.hand_configuration.tolist())
            rows.append(replay_object(str(name), hand, numbers, mesh, settings))
    return pd.DataFrame(rows, columns=list(REPLAY_SCHEMA.columns))
