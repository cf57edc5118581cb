"""How well roles are recognised: on families of kinds that were left out, and on scans of known
objects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from grasptypes.kinds.names import shape_of
from grasptypes.objects.object_files import Surface
from grasptypes.segmentation.parts import Parts, describe_surface, described, find_parts
from grasptypes.segmentation.samples import RoleSamples
from grasptypes.segmentation.training import family_folds, train_network
from grasptypes.settings.holds import read_hold_table
from grasptypes.settings.roles import read_roles
from grasptypes.settings.segmentation import SegmentationSettings

Array = NDArray[np.float64]

# Weight of a difference between normals against metres: the other side of a wall is far away.
NORMAL_M = 0.003
SHARE = pa.Check.in_range(0, 1)
KIND_SCHEMA = pa.DataFrameSchema(
    {
        "kind": pa.Column(str, unique=True),
        "family": pa.Column(str, description="kinds that are left out together"),
        "accuracy": pa.Column(float, SHARE, description="share of the surface with the right role"),
        "pointwise": pa.Column(float, SHARE, description="the same before points listen to others"),
        "same_holds": pa.Column(
            float, SHARE, description="share with a role that people hold in the same way"
        ),
    },
    strict=True,
    ordered=True,
)
ROLE_SCHEMA = pa.DataFrameSchema(
    {
        "role": pa.Column(str),
        "area_share": pa.Column(float, SHARE, description="of the surfaces of all shapes"),
        "recognised": pa.Column(float, SHARE, description="share of the role's surface"),
        "taken_for": pa.Column(str, description="most frequent other role; empty without one"),
    },
    strict=True,
    ordered=True,
)
FOUND_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str, unique=True),
        "found": pa.Column(str, description="parts that were found, and how sure they are"),
    },
    strict=True,
    ordered=True,
)
SCAN_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str, unique=True),
        "accuracy": pa.Column(float, SHARE, description="share of the surface with the right role"),
        "same_holds": pa.Column(float, SHARE),
        "found": pa.Column(str, description="parts that were found, and how sure they are"),
    },
    strict=True,
    ordered=True,
)


@dataclass(frozen=True)
class FoundRoles:
    """Roles of the points of tested shapes, as places in roles.yaml.

    Attributes:
        rows: (T,) shapes that were tested: the first of each kind.
        pointwise: (T, M) by the network alone.
        smoothed: (T, M) after points have listened to their neighbours and crumbs have joined
            parts.
    """

    rows: NDArray[np.intp]
    pointwise: NDArray[np.intp]
    smoothed: NDArray[np.intp]


def held_out_roles(samples: RoleSamples, settings: SegmentationSettings, seed: int) -> FoundRoles:
    """Roles of the first shape of each kind, by networks that have seen none of its family."""
    folds = family_folds(samples.families, settings.training.folds, ("folds", seed))
    kinds = np.array([shape_of(name)[0] for name in samples.shapes])
    first = np.unique(kinds, return_index=True)[1]
    found = {}
    for fold in range(settings.training.folds):
        seen = np.flatnonzero(folds != fold)
        network = train_network(samples, seen, settings.training, ("fold", fold, seed))
        for row in first[folds[first] == fold]:
            cloud = (
                samples.points_m[row].astype(np.float64),
                samples.normals[row].astype(np.float64),
            )
            parts = find_parts(*cloud, settings, network)
            chances = network.probabilities(describe_surface(*cloud, settings))
            found[row] = chances.argmax(axis=1), role_index(parts)
    rows = np.array(sorted(found))
    return FoundRoles(rows, *(np.stack([found[row][k] for row in rows]) for k in (0, 1)))


def role_index(parts: Parts) -> NDArray[np.intp]:
    """Role (N,) of each point as its place in roles.yaml; -1 without a role."""
    order = list(read_roles().roles)
    places = [order.index(part.role) if part else -1 for part in parts.roles.values()]
    of_point: NDArray[np.intp] = np.array(places)[parts.part_index]
    return of_point


def hold_groups() -> NDArray[np.intp]:
    """Group (R,) of holds of each role of roles.yaml: roles that people hold in the same way; -1
    if nobody does."""
    groups = read_hold_table().groups.values()
    return np.array(
        [
            next((at for at, group in enumerate(groups) if role in group.roles), -1)
            for role in read_roles().roles
        ]
    )


def kind_table(samples: RoleSamples, found: FoundRoles) -> pd.DataFrame:
    """One row per kind, see `KIND_SCHEMA`."""
    true, group = samples.roles[found.rows], hold_groups()
    return pd.DataFrame(
        {
            "kind": [shape_of(name)[0] for name in samples.shapes[found.rows]],
            "family": samples.families[found.rows],
            "accuracy": (found.smoothed == true).mean(axis=1),
            "pointwise": (found.pointwise == true).mean(axis=1),
            "same_holds": (group[found.smoothed] == group[true]).mean(axis=1),
        }
    ).round(4)


def role_table(samples: RoleSamples, found: FoundRoles) -> pd.DataFrame:
    """One row per role that occurs, see `ROLE_SCHEMA`."""
    true, names, rows = samples.roles[found.rows], list(read_roles().roles), []
    for number in np.unique(true):
        there = true == number
        answers = np.bincount(found.smoothed[there], minlength=len(names))
        others = answers.copy()
        others[number] = 0
        rows.append(
            {
                "role": names[number],
                "area_share": there.mean(),
                "recognised": answers[number] / there.sum(),
                "taken_for": names[others.argmax()] if others.any() else "",
            }
        )
    return pd.DataFrame(rows).round(4)


def transferred_roles(
    surface: Surface, roles: Sequence[int], points_m: Array, normals: Array
) -> NDArray[np.intp]:
    """Role (N,) of points (N, 3) near a surface: that of the nearest vertex that faces the same
    way.

    Args:
        roles: role of each part of the surface.
    """
    turned = trimesh.Trimesh(surface.vertices, surface.faces, process=False).vertex_normals
    tree = cKDTree(np.hstack([surface.vertices, NORMAL_M * turned]))
    nearest = tree.query(np.hstack([points_m, NORMAL_M * normals]))[1]
    of_point: NDArray[np.intp] = np.asarray(roles)[surface.part_index[nearest]]
    return of_point


def scan_row(name: str, parts: Parts, true: NDArray[np.intp]) -> dict[str, object]:
    """A row of `SCAN_SCHEMA`."""
    answer, group = role_index(parts), hold_groups()
    return {
        "object": name,
        "accuracy": round(float((answer == true).mean()), 4),
        "same_holds": round(float((group[answer] == group[true]).mean()), 4),
        "found": described(parts),
    }
