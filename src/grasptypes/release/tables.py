"""The tables of a release, and what their columns mean."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from grasptypes.hands.hand import Hand
from grasptypes.labels.contact_table import NORMAL_COLUMNS, POINT_COLUMNS, contact_rows
from grasptypes.labels.dataset import dataset_schema
from grasptypes.labels.samples import SAMPLE_SCHEMA
from grasptypes.objects.object_files import PROPERTIES, SURFACE, read_properties, read_surface
from grasptypes.predictors.folds import FOLD_SCHEMA
from grasptypes.tables import read_table

HELD_OUT, FITTED = "held_out", "fitted"

# What the columns of each table mean; those of a hand's joints are named like its joints.
MEANINGS = {
    "Index": "number of the grasp, from 0",
    "Object": "name of the object",
    "Intent": "task: what the object is grasped for",
    "Session": "person whose hold was searched for, from 1",
    "GraspType": "one of seven; Invalid if the physics test rejects the grasp",
    "GraspTypeIndex": "1 to 7, in the order of the published table",
    "Rank": "from 1",
    "Error": "energy of the search; low is good",
    "PoseIndex": "position among the candidates tried, from 0",
    "HandConfiguration": "rank index, 3x4 pose of the palm in the object's frame row by row "
    "(metres), degrees of freedom (radians)",
    "Image": "screenshots/<object>_<session>_<task>.png, in images/screenshots/<object>.zip",
    "hand": "name of the hand",
    "reason": "valid, or why the physics test rejects the grasp",
    "shape": "type by the labelling rule, whether or not the grasp is valid",
    "branch": "way through the rule's tree, with the values that decided it",
    "margin": "relative distance to the nearest threshold on that way",
    "diameter_m": "enclosed diameter, metres",
    "palm_gap_m": "from the palm to the object, metres",
    "sideways_share": "share of the push that is sideways",
    "span_m": "between the fingertips, metres",
    "virtual_fingers": "2 or 3",
    "penetration_m": "how deep hand and object are in each other, metres",
    "tries": "number of candidates tried",
    "bears_load": "whether the grasp also held under the task's own load",
    "stopped_joints": "number of stopped joints of each finger, as held",
    "touching_pose": "3x4 pose of the palm before the fingers squeeze, row by row (metres)",
    "touching_joints": "all joints there (radians, prismatic joints metres)",
    "pregrasp_pose": "3x4 pose of the palm in front of the object, row by row (metres)",
    "pregrasp_joints": "all joints there, the hand is open (radians, prismatic joints metres)",
    "link": "link of the hand that touches",
    **dict.fromkeys(POINT_COLUMNS, "contact in the object's frame, metres"),
    **dict.fromkeys(NORMAL_COLUMNS, "unit normal into the object"),
    "force_n": "of the hand along the normal at the end of the physics test, newtons",
    "object": "name of the object",
    "task": "use or handoff",
    "n_valid": "number of valid grasps",
    "view": "number of the image in images/renders/<object>.zip, from 0",
    "fold": "test fold of the image, from 0: the paper's folds, in which all objects are known",
    "split": f"{FITTED}: published labels or poses of this object were used to derive numbers of "
    f"the synthesis; {HELD_OUT}: they were not. To test on unseen objects, leave out whole objects",
    "file": "GLB in metres; a node for each part",
    "mass_kg": "kilograms",
    "volume_m3": "cubic metres",
    "part": "part of the object",
    "node": "node of the GLB",
    "role": "what the part is for; empty if it has no role",
    "area_m2": "surface of the part, square metres",
}


def release_tables(data: Path, hand: Hand, fitted_on: Sequence[str]) -> dict[str, pd.DataFrame]:
    """All tables of a release, from the files that the workflow computes.

    Args:
        fitted_on: objects whose published labels were used to derive numbers.

    Raises:
        InputError: a file is missing or damaged.
    """
    grasps = read_table(data / "grasps.csv", dataset_schema(hand))
    names = list(dict.fromkeys(grasps.Object))
    splits = [FITTED if name in fitted_on else HELD_OUT for name in names]
    return {
        "grasps": grasps,
        "contacts": _contacts(data, grasps),
        "samples": read_table(data / "samples.csv", SAMPLE_SCHEMA),
        "folds": read_table(data / "folds.csv", FOLD_SCHEMA),
        "splits": pd.DataFrame({"Object": names, "split": splits}),
        "objects": pd.DataFrame([_object(data, name) for name in names]),
        "parts": pd.DataFrame([part for name in names for part in _parts(data, name)]),
        "views": pd.concat(
            [pd.read_csv(data / "renders" / f"{name}.csv") for name in names], ignore_index=True
        ),
    }


def _contacts(data: Path, grasps: pd.DataFrame) -> pd.DataFrame:
    """One row per contact of a grasp, in the order of the grasps."""
    index = grasps.set_index(["Object", "Intent", "Session"]).Index
    found = []
    for name, task in dict.fromkeys(zip(grasps.Object, grasps.Intent, strict=True)):
        for row in pd.read_parquet(data / "grasps" / name / f"{task}.parquet").itertuples():
            found.append(
                contact_rows(
                    "Index",
                    index[name, task, row.session],
                    row.contact_links,
                    row.contact_points_m,
                    row.contact_normals,
                    row.contact_forces_n,
                )
            )
    table = pd.concat(found, ignore_index=True)
    return table.sort_values("Index", kind="stable", ignore_index=True).round(9)


def _object(data: Path, name: str) -> dict[str, object]:
    properties = read_properties(data / "objects" / name / PROPERTIES)
    return {
        "Object": name,
        "file": f"objects/{name}.glb",
        "mass_kg": properties.mass_kg,
        "volume_m3": properties.volume_m3,
    }


def _parts(data: Path, name: str) -> list[dict[str, object]]:
    surface, roles = read_surface(data / "objects" / name / SURFACE), part_roles(data, name)
    corners = surface.vertices[surface.faces]
    areas = (
        np.linalg.norm(np.cross(*np.moveaxis(corners[:, 1:] - corners[:, :1], 1, 0)), axis=1) / 2
    )
    owners = surface.part_index[surface.faces[:, 0]]
    return [
        {
            "Object": name,
            "part": str(part),
            "node": f"{part}_{place}",
            "role": roles.get(str(part), ""),
            "area_m2": round(float(areas[owners == place].sum()), 9),
        }
        for place, part in enumerate(surface.part_names)
    ]


def part_roles(data: Path, name: str) -> dict[str, str]:
    """Role of each part of an object that has one."""
    properties = json.loads((data / "objects" / name / PROPERTIES).read_text(encoding="utf-8"))
    return {part: str(known["role"]) for part, known in properties.get("roles", {}).items()}
