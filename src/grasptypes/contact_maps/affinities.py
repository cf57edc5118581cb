"""The affinity table: which part of an object people hold for a task, how, and from which side.

Each row is one way of holding. Its affinity is a weight relative to the other rows of the same
object and task; affinities need not sum to one. Add rows for your own objects and further tasks.
"""

from __future__ import annotations

import csv
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from grasptypes.errors import InputError

COLUMNS = (
    "object", "task", "part", "grip", "approach", "axis", "low", "high", "affinity", "reason",
)  # fmt: skip
# Each grip belongs to one of the two styles in Figure 2 (a) of the paper.
STYLE_OF_GRIP = {
    "wrap": "power",
    "enclose": "power",
    "tripod": "precision",
    "pinch": "precision",
    "rim": "precision",
}
SIDES = ("+x", "-x", "+y", "-y", "+z", "-z")
APPROACHES = ("around", *SIDES)
AXES = ("", "x", "y", "z")
WHOLE = "*"


@dataclass(frozen=True)
class AffinityRow:
    """One way to hold an object for a task.

    Attributes:
        parts: names of the touched parts; empty for the whole object.
        grip: `wrap` (palm and parallel fingers around the axis), `enclose` (palm and spread
            fingers), `tripod` (fingertips spread around the approach), `pinch` (fingertips against
            the thumb), `rim` (fingertips on both sides of a wall's edge).
        approach: side of the object where the palm is, or `around` for any side of the axis.
        axis: object axis around which the part is held; empty for the part's longest extent.
        low, high: range of the hand's centre along that axis, as fractions of the parts' extent.
        affinity: weight among the holds of the same object and task.
        reason: why people hold it this way, or the evidence.
    """

    parts: tuple[str, ...]
    grip: str
    approach: str
    axis: str
    low: float
    high: float
    affinity: float
    reason: str


def read_affinities(
    path: str | Path, objects: Collection[str], tasks: Collection[str]
) -> dict[tuple[str, str], tuple[AffinityRow, ...]]:
    """Read and check the table.

    Args:
        path: CSV with the columns `COLUMNS`, UTF-8.
        objects: allowed object names.
        tasks: tasks to return; rows of other tasks are checked and dropped.

    Returns:
        The holds of each (object, task) that has any, in the table's order.

    Raises:
        InputError: names the line and column of the first bad cell.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (FileNotFoundError, IsADirectoryError) as error:
        raise InputError(path, "", "no such affinity table") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "", f"not UTF-8 text: {error}") from error
    reader = csv.DictReader(text.splitlines())
    try:
        rows = list(reader)
    except csv.Error as error:
        raise InputError(path, f"line {reader.line_num}", f"not a CSV row: {error}") from error
    if tuple(reader.fieldnames or ()) != COLUMNS:
        raise InputError(path, "line 1", f"the columns must be {', '.join(COLUMNS)}")
    table: dict[tuple[str, str], list[AffinityRow]] = {}
    for line, row in enumerate(rows, start=2):
        if None in row or None in row.values():
            raise InputError(path, f"line {line}", f"must have {len(COLUMNS)} cells")
        _check_choice(path, line, "object", row["object"], objects)
        hold = _hold(path, line, row)
        if row["task"] in tasks:
            table.setdefault((row["object"], row["task"]), []).append(hold)
    for key, holds in table.items():
        if sum(hold.affinity for hold in holds) <= 0:
            raise InputError(path, "affinity", f"is zero in every row of {' and '.join(key)}")
    return {key: tuple(holds) for key, holds in table.items()}


def check_rows(
    rows: Collection[AffinityRow],
    name: tuple[str, str],
    part_names: Collection[str],
    path: str | Path,
) -> None:
    """Check that an object and task (`name`) has rows, and that the object has their parts.

    Raises:
        InputError: there is no row for them, or a row names a part the object does not have.
    """
    if not rows:
        raise InputError(path, " and ".join(name), "has no row; add at least one")
    for row in rows:
        for part in row.parts:
            if part not in part_names:
                allowed = ", ".join([*part_names, WHOLE])
                where = f"part of {' and '.join(name)}"
                raise InputError(path, where, f"'{part}' is not one of {allowed}")


def _hold(path: Path, line: int, row: Mapping[str, Any]) -> AffinityRow:
    _check_choice(path, line, "grip", row["grip"], STYLE_OF_GRIP)
    _check_choice(path, line, "approach", row["approach"], APPROACHES)
    _check_choice(path, line, "axis", row["axis"], AXES)
    low = _number(path, line, row, "low", 0.0, 1.0)
    hold = AffinityRow(
        parts=() if row["part"] == WHOLE else tuple(row["part"].split("+")),
        grip=row["grip"],
        approach=row["approach"],
        axis=row["axis"],
        low=low,
        high=_number(path, line, row, "high", low, 1.0),
        affinity=_number(path, line, row, "affinity", 0.0, float("inf")),
        reason=row["reason"].strip(),
    )
    if not hold.reason:
        raise InputError(path, f"line {line}, reason", "must say why people hold it this way")
    return hold


def _check_choice(path: Path, line: int, column: str, value: str, allowed: Collection[str]) -> None:
    if value not in allowed:
        choices = ", ".join(choice or "(empty)" for choice in allowed)
        raise InputError(path, f"line {line}, {column}", f"'{value}' is not one of {choices}")


def _number(
    path: Path, line: int, row: Mapping[str, str], column: str, low: float, high: float
) -> float:
    try:
        value = float(row[column])
    except ValueError as error:
        message = f"'{row[column]}' is not a number"
        raise InputError(path, f"line {line}, {column}", message) from error
    if not low <= value <= high or value == float("inf"):
        message = f"{value:g} is not between {low:g} and {high:g}"
        raise InputError(path, f"line {line}, {column}", message)
    return value
