"""How well roles are recognised: on families of kinds that were left out, and on scans."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh
from numpy.typing import NDArray

from grasptypes.kinds.names import shape_of
from grasptypes.segmentation.network import RoleModel, RoleNetwork
from grasptypes.segmentation.partial_views import partial_views
from grasptypes.segmentation.parts import (
    Parts,
    describe_surface,
    described,
    find_parts,
    likely_parts,
)
from grasptypes.segmentation.samples import RoleSamples, sample_evenly
from grasptypes.segmentation.true_roles import TrueRoles
from grasptypes.settings.holds import read_hold_table
from grasptypes.settings.roles import read_roles
from grasptypes.settings.segmentation import SegmentationSettings

LOGGER = logging.getLogger("grasptypes")

NETWORK_METHOD, FOREST_METHOD = METHODS = ("network", "forest")
SHARE = pa.Check.in_range(0, 1)
KIND_SCHEMA = pa.DataFrameSchema(
    {
        "method": pa.Column(str, pa.Check.isin(METHODS)),
        "kind": pa.Column(str),
        "family": pa.Column(str, description="kinds that are left out together"),
        "accuracy": pa.Column(float, SHARE, description="share of the surface with the right role"),
        "pointwise": pa.Column(float, SHARE, description="the same before points listen to others"),
        "same_holds": pa.Column(
            float, SHARE, description="share with a role that people hold in the same way"
        ),
    },
    strict=True,
    ordered=True,
    unique=["method", "kind"],
)
ROLE_SCHEMA = pa.DataFrameSchema(
    {
        "method": pa.Column(str, pa.Check.isin(METHODS)),
        "role": pa.Column(str),
        "area_share": pa.Column(float, SHARE, description="of the surfaces of all shapes"),
        "recognised": pa.Column(float, SHARE, description="share of the role's surface"),
        "taken_for": pa.Column(str, description="most frequent other role; empty without one"),
    },
    strict=True,
    ordered=True,
    unique=["method", "role"],
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
        "one_side": pa.Column(
            float,
            SHARE,
            description="accuracy if only points visible from a side are known; mean of four",
        ),
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


def held_out_roles(
    samples: RoleSamples,
    folds: NDArray[np.intp],
    methods: Mapping[str, Callable[[int], RoleModel]],
    settings: SegmentationSettings,
) -> dict[str, FoundRoles]:
    """Roles of the first shape of each kind, by models that have seen none of its family.

    Args:
        folds: (S,) fold of each shape.
        methods: by name, what gives the model of a fold, which has seen all others; the models of
            one fold are kept at a time.

    Returns:
        What each method finds, by name.
    """
    kinds = np.array([shape_of(name)[0] for name in samples.shapes])
    rows = np.unique(kinds, return_index=True)[1]
    rows = rows[np.lexsort([rows, folds[rows]])]
    pointwise: dict[str, list[NDArray[np.intp]]] = {method: [] for method in methods}
    smoothed: dict[str, list[NDArray[np.intp]]] = {method: [] for method in methods}
    for fold in np.unique(folds[rows]):
        models = {method: learn(int(fold)) for method, learn in methods.items()}
        tested = rows[folds[rows] == fold]
        for row in tested:
            points_m, normals = (
                each[row].astype(np.float64) for each in (samples.points_m, samples.normals)
            )
            descriptors = describe_surface(points_m, normals, settings)
            for method, model in models.items():
                chances = model.probabilities(descriptors)
                parts = likely_parts(points_m, normals, chances, model.roles, settings)
                pointwise[method].append(chances.argmax(axis=1))
                smoothed[method].append(role_index(parts))
        LOGGER.info("fold %d: tested %d kinds", fold, len(tested))
    order = np.argsort(rows)
    return {
        method: FoundRoles(
            rows[order], np.stack(pointwise[method])[order], np.stack(smoothed[method])[order]
        )
        for method in methods
    }


def role_index(parts: Parts) -> NDArray[np.intp]:
    """Role (N,) of each point as its place in roles.yaml; -1 without a role."""
    order = list(read_roles().roles)
    places = [order.index(part.role) if part else -1 for part in parts.roles.values()]
    of_point: NDArray[np.intp] = np.array(places)[parts.part_index]
    return of_point


def hold_groups() -> NDArray[np.intp]:
    """Group (R,) of each role of roles.yaml: roles that people hold in the same way.

    It is -1 for roles that nobody holds.
    """
    groups = read_hold_table().groups.values()
    return np.array(
        [
            next((at for at, group in enumerate(groups) if role in group.roles), -1)
            for role in read_roles().roles
        ]
    )


def kind_table(method: str, samples: RoleSamples, found: FoundRoles) -> pd.DataFrame:
    """One row per kind, see `KIND_SCHEMA`."""
    true, group = samples.roles[found.rows], hold_groups()
    return pd.DataFrame(
        {
            "method": method,
            "kind": [shape_of(name)[0] for name in samples.shapes[found.rows]],
            "family": samples.families[found.rows],
            "accuracy": (found.smoothed == true).mean(axis=1),
            "pointwise": (found.pointwise == true).mean(axis=1),
            "same_holds": (group[found.smoothed] == group[true]).mean(axis=1),
        }
    ).round(4)


def role_table(method: str, samples: RoleSamples, found: FoundRoles) -> pd.DataFrame:
    """One row per role that occurs, see `ROLE_SCHEMA`."""
    true, names, rows = samples.roles[found.rows], list(read_roles().roles), []
    for number in np.unique(true):
        there = true == number
        answers = np.bincount(found.smoothed[there], minlength=len(names))
        others = answers.copy()
        others[number] = 0
        rows.append(
            {
                "method": method,
                "role": names[number],
                "area_share": there.mean(),
                "recognised": answers[number] / there.sum(),
                "taken_for": names[others.argmax()] if others.any() else "",
            }
        )
    return pd.DataFrame(rows).round(4)


def scan_row(
    mesh: trimesh.Trimesh,
    name: str,
    true: TrueRoles,
    settings: SegmentationSettings,
    network: RoleNetwork,
) -> dict[str, object]:
    """A row of `SCAN_SCHEMA`, for a scan in metres."""
    points_m, face = sample_evenly(mesh, settings.descriptors.points, name)
    normals = mesh.face_normals[face]
    parts = find_parts(points_m, normals, settings, network)
    answer, known, group = role_index(parts), true.index_at(points_m, normals), hold_groups()
    from_sides = [
        (role_index(find_parts(*seen, settings, network)) == true.index_at(*seen)).mean()
        for seen in partial_views(mesh, settings.descriptors.points, name)
    ]
    return {
        "object": name,
        "accuracy": round(float((answer == known).mean()), 4),
        "same_holds": round(float((group[answer] == group[known]).mean()), 4),
        "one_side": round(float(np.mean(from_sides)), 4),
        "found": described(parts),
    }
