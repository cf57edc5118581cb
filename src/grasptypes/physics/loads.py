"""The load that a task puts on a grasp besides the object's weight: a table with reasons.

A row of the table names an object (or `*` for those without a row of their own), a task, the part
at whose centre the load acts (or `*` for the centre of mass), its direction (an axis of the object,
or `away` from the palm, along the hand's approach), its force and the reason for it.
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.objects.object_geometry import ObjectGeometry

Array = NDArray[np.float64]

COLUMNS = ("object", "task", "part", "direction", "force_n", "reason")
ANY = "*"
AWAY = "away"
AXES = {
    f"{sign}{axis}": float(f"{sign}1") * np.eye(3)[index]
    for index, axis in enumerate("xyz")
    for sign in "+-"
}
DIRECTIONS = (*AXES, AWAY)
# Twice the force with which a strong hand grips: more is a typing error.
MOST_N = 1000.0


class TaskLoad(NamedTuple):
    """A force on an object."""

    point_m: Array
    """(3,) where it acts, in the object's frame."""
    direction: str
    """One of `DIRECTIONS`."""
    force_n: float

    def force(self, T_object_hand: Array) -> Array:
        """(3,) newtons, in the frame of a hand at a pose (4, 4)."""
        away = np.array([0.0, 0.0, 1.0])
        if self.direction == AWAY:
            return self.force_n * away
        return np.asarray(self.force_n * (T_object_hand[:3, :3].T @ AXES[self.direction]))


def task_load(path: str | Path, geometry: ObjectGeometry, task: str) -> TaskLoad | None:
    """The load of an object and task, from the table; None if the table has none for the task.

    Raises:
        InputError: the table cannot be read, or a row is wrong.
    """
    chosen = None
    for place, row in _rows(path):
        if row["task"] != task or row["object"] not in (ANY, geometry.name):
            continue
        if chosen is None or row["object"] != ANY:
            chosen = place, row
    if chosen is None:
        return None
    place, row = chosen
    point = _point(geometry, row["part"], path, place)
    return TaskLoad(point, row["direction"], float(row["force_n"]))


def _rows(path: str | Path) -> list[tuple[str, dict[str, str]]]:
    """The rows with their places, checked."""
    try:
        with Path(path).open(encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file)
            rows = [(f"row {number}", row) for number, row in enumerate(reader, start=2)]
            columns = tuple(reader.fieldnames or ())
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(path, "", f"cannot be read as a table: {error}") from error
    if columns != COLUMNS:
        raise InputError(path, "columns", f"must be {', '.join(COLUMNS)}")
    seen: dict[tuple[str, str], str] = {}
    for place, row in rows:
        _check(path, place, row)
        key = row["object"], row["task"]
        if key in seen:
            raise InputError(path, place, f"{' for '.join(key)} is also in {seen[key]}")
        seen[key] = place
    return rows


def _check(path: str | Path, place: str, row: dict[str, str]) -> None:
    if None in row or None in row.values():
        raise InputError(path, place, f"needs {len(COLUMNS)} cells")
    if row["direction"] not in DIRECTIONS:
        allowed = ", ".join(DIRECTIONS)
        raise InputError(path, f"{place}, direction", f"'{row['direction']}' is not of {allowed}")
    try:
        force = float(row["force_n"])
    except ValueError as error:
        said = f"'{row['force_n']}' is not a number"
        raise InputError(path, f"{place}, force_n", said) from error
    if not 0.0 <= force <= MOST_N:
        raise InputError(path, f"{place}, force_n", f"must be 0 to {MOST_N:g} N")
    if not row["reason"]:
        raise InputError(path, f"{place}, reason", "is empty: say where the number is from")


def _point(geometry: ObjectGeometry, part: str, path: str | Path, place: str) -> Array:
    if part == ANY:
        return np.array(geometry.properties.centre_of_mass_m)
    surface = geometry.surface
    names = surface.part_names.tolist()
    if part not in names:
        message = f"'{part}' is no part of {geometry.name}: {', '.join(names)}"
        raise InputError(path, f"{place}, part", message)
    held = surface.vertices[surface.part_index == names.index(part)]
    return np.asarray(held.mean(axis=0))
