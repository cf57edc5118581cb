"""Statistics of the grasps of kinds: what holds and why not, and types by role and size."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pandera.pandas as pa
from scipy.spatial import cKDTree

from grasptypes.kinds.names import shape_of
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.labels.samples import TYPES
from grasptypes.objects.object_geometry import ObjectGeometry, read_object
from grasptypes.synthesis.grasps import GRASP_SCHEMA, REASONS
from grasptypes.tables import read_table

# Upper limits of the size classes: the middle side of the object's box, metres.
SIZES_M = (0.03, 0.05, 0.08, 0.12)
NO_ROLE = "none"

KIND_TABLE = pa.DataFrameSchema(
    {
        "kind": pa.Column(str),
        "group": pa.Column(str),
        "task": pa.Column(str),
        "shapes": pa.Column(int, pa.Check.ge(1)),
        "grasps": pa.Column(int, pa.Check.ge(1)),
        "valid": pa.Column(int, pa.Check.ge(0)),
        "valid_share": pa.Column(float, pa.Check.in_range(0, 1)),
        **{reason: pa.Column(int, pa.Check.ge(0)) for reason in REASONS},
        **{name: pa.Column(int, pa.Check.ge(0)) for name in TYPES},
    },
    strict=True,
    ordered=True,
    unique=["kind", "task"],
)
ROLE_TABLE = pa.DataFrameSchema(
    {
        "role": pa.Column(str, description="of the part with most of the contact forces"),
        "size": pa.Column(str, description="middle side of the object's box"),
        "task": pa.Column(str),
        "grasps": pa.Column(int, pa.Check.ge(1)),
        "valid": pa.Column(int, pa.Check.ge(0)),
        **{name: pa.Column(int, pa.Check.ge(0)) for name in TYPES},
    },
    strict=True,
    ordered=True,
    unique=["role", "size", "task"],
)


def held_role(row: Any, tree: cKDTree, geometry: ObjectGeometry) -> str:
    """Role of the part that bears most of a grasp's contact forces.

    Args:
        row: of `GRASP_SCHEMA`.
        tree: of the vertices of the object's surface.
    """
    points_m = np.asarray(row.contact_points_m, dtype=np.float64).reshape(-1, 3)
    if not len(points_m):
        return NO_ROLE
    surface, forces_n = geometry.surface, np.asarray(row.contact_forces_n, dtype=np.float64)
    parts = surface.part_index[tree.query(points_m)[1]]
    # Weights stay above 0, so that contacts without force count too.
    load = np.bincount(parts, forces_n + 1e-9, minlength=len(surface.part_names))
    name = str(surface.part_names[int(load.argmax())])
    return str(geometry.properties.roles.get(name, {}).get("role", NO_ROLE))


def size_class(geometry: ObjectGeometry) -> str:
    """The size class of an object, such as `3-5 cm`."""
    lower, upper = np.asarray(geometry.properties.bounds_m)
    middle_m = float(np.sort(upper - lower)[1])
    limits = [0.0, *SIZES_M]
    index = int(np.searchsorted(SIZES_M, middle_m))
    low = f"{100 * limits[index]:.0f}"
    return f"{low}-{100 * SIZES_M[index]:.0f} cm" if index < len(SIZES_M) else f"over {low} cm"


def grasp_roles(tables: Iterable[str | Path], objects: Mapping[str, Path]) -> pd.DataFrame:
    """Object, task, session, held role and size class of every grasp.

    One table and one object are in memory at a time.

    Args:
        tables: files of `GRASP_SCHEMA`.
        objects: folder of each object.
    """
    rows: list[tuple[str, str, int, str, str]] = []
    for path in tables:
        grasps = read_table(path, GRASP_SCHEMA)
        for name, some in grasps.groupby("object", sort=True):
            geometry = read_object(objects[str(name)])
            tree, size = cKDTree(geometry.surface.vertices), size_class(geometry)
            rows += [
                (str(name), row.task, int(row.session), held_role(row, tree, geometry), size)
                for row in some.itertuples()
            ]
    return pd.DataFrame(rows, columns=["object", "task", "session", "role", "size"])


def kind_tables(
    dataset: pd.DataFrame, roles: pd.DataFrame, groups: Mapping[str, str]
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """A `KIND_TABLE` and a `ROLE_TABLE`.

    Args:
        dataset: the labelled grasps, see :mod:`grasptypes.labels.dataset`.
        roles: of :func:`grasp_roles`.
        groups: the group of each kind.
    """
    table = pd.DataFrame(
        {
            "object": dataset.Object,
            "task": dataset.Intent,
            "session": dataset.Session,
            "reason": dataset.reason,
            "type": dataset["shape"].map(dict(zip(GRASP_TYPES, TYPES, strict=False))),
        }
    )
    table["kind"] = [shape_of(name)[0] for name in table.object]
    table = table.merge(roles, on=["object", "task", "session"], validate="one_to_one")
    kinds = []
    for (kind, task), rows in table.groupby(["kind", "task"], sort=True):
        kinds.append(
            {
                "kind": kind, "group": groups[str(kind)], "task": task,
                "shapes": rows.object.nunique(), **_counts(rows),
            }
        )  # fmt: skip
    by_role = [
        {"role": role, "size": size, "task": task, **_counts(rows)}
        for (role, size, task), rows in table.groupby(["role", "size", "task"], sort=True)
    ]
    ours = pd.DataFrame(kinds)[list(KIND_TABLE.columns)]
    return ours, pd.DataFrame(by_role)[list(ROLE_TABLE.columns)]


def _counts(rows: pd.DataFrame) -> dict[str, Any]:
    """Numbers of grasps, of valid ones, of reasons, and of the types of valid ones."""
    valid = rows[rows.reason == "valid"]
    return {
        "grasps": len(rows),
        "valid": len(valid),
        "valid_share": round(len(valid) / len(rows), 3),
        **{reason: int((rows.reason == reason).sum()) for reason in REASONS},
        **{name: int((valid.type == name).sum()) for name in TYPES},
    }
