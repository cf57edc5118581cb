"""datapackage.json: what is in a release, as Frictionless Data describes it (Data Package v1)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from grasptypes.files import file_sha256
from grasptypes.release.tables import MEANINGS

KEYS = {
    "grasps": ["Index"],
    "samples": ["object", "task"],
    "folds": ["object", "view"],
    "views": ["object", "view"],
    "splits": ["Object"],
    "objects": ["Object"],
    "parts": ["Object", "part"],
}
# Tables whose rows belong to rows of another: column, table, column there.
REFERENCES = {
    "contacts": ("Index", "grasps", "Index"),
    "grasps": ("Object", "splits", "Object"),
    "parts": ("Object", "objects", "Object"),
    "folds": ("object", "objects", "Object"),
}
TITLES = {
    "grasps": "Grasps with their types and the values that decided them",
    "contacts": "Contacts of the valid grasps",
    "samples": "Grasp types of each object and task: counts, probabilities and labels",
    "folds": "Test folds of the images",
    "splits": "Split of the objects",
    "objects": "Objects",
    "parts": "Parts of the objects",
    "views": "Camera poses of the images",
}


def describe(folder: Path, tables: Mapping[str, pd.DataFrame], version: str) -> dict[str, Any]:
    """The description of all files that are in the folder."""
    described = [_table(folder, name, table) for name, table in tables.items()]
    known = {f"{name}.csv" for name in tables}
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    others = [
        _file(folder, path) for path in files if path.relative_to(folder).as_posix() not in known
    ]
    return {
        "profile": "data-package",
        "name": "grasptypes",
        "title": "Task-specific grasps of a robot hand on household objects, with their types",
        "description": "See datasheet.md. Lengths are in metres, angles in radians.",
        "version": version,
        "licenses": [{"name": "MIT", "path": "LICENSE", "title": "MIT License"}],
        "keywords": ["robotics", "grasping", "grasp types", "multi-fingered hand", "affordances"],
        "resources": described + others,
    }


def _file(folder: Path, path: Path) -> dict[str, Any]:
    name = path.relative_to(folder).as_posix()
    return {
        "name": re.sub(r"[^a-z0-9._/-]", "-", name.lower()).replace("/", "."),
        "type": "file",
        "path": name,
        "format": path.suffix[1:].lower() or "txt",
        "scheme": "file",
        "bytes": path.stat().st_size,
        "hash": f"sha256:{file_sha256(path)}",
    }


def _table(folder: Path, name: str, table: pd.DataFrame) -> dict[str, Any]:
    schema: dict[str, Any] = {
        "fields": [
            {"name": column, "type": _kind(values), "description": _meaning(str(column))}
            for column, values in table.items()
        ],
    }
    if name in KEYS:
        schema["primaryKey"] = KEYS[name]
    if name in REFERENCES:
        column, other, there = REFERENCES[name]
        reference = {"resource": other, "fields": [there]}
        schema["foreignKeys"] = [{"fields": [column], "reference": reference}]
    return {
        **_file(folder, folder / f"{name}.csv"),
        "name": name,
        "type": "table",
        "title": TITLES[name],
        "profile": "tabular-data-resource",
        "mediatype": "text/csv",
        "encoding": "utf-8",
        "schema": schema,
    }


def _kind(values: pd.Series) -> str:
    if pd.api.types.is_integer_dtype(values):
        return "integer"
    return "number" if pd.api.types.is_float_dtype(values) else "string"


def _meaning(column: str) -> str:
    if column in MEANINGS:
        return MEANINGS[column]
    if column.endswith(("_rad", "_m")):
        return "joint position, radians" if column.endswith("_rad") else "joint position, metres"
    kinds = {
        "count_": "number of valid grasps of a type",
        "probability_": "share of a type; equal for all types that occur",
        "label_": "1 if the type occurs",
        "T_object_camera_": "element of the camera's pose; the camera looks along -z, y is up",
    }
    return next((said for start, said in kinds.items() if column.startswith(start)), "")
