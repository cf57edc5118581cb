"""A user's table of roles: which part of a mesh is for what."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import NamedTuple

from grasptypes.errors import InputError, parsing
from grasptypes.settings.roles import PartRole

COLUMNS = ("part", "role")
ATTRIBUTES = "attributes"
COLOUR = re.compile(r"#[0-9a-f]{6}")


class RoleTable(NamedTuple):
    """What a user says about parts.

    Attributes:
        path: the table, for errors.
        roles: role of each part by name, or by colour such as #c81e1e.
    """

    path: Path
    roles: dict[str, PartRole]

    @property
    def by_colour(self) -> bool:
        """Whether colours stand for parts."""
        return next(iter(self.roles)).startswith("#")


def read_role_table(path: str | Path) -> RoleTable:
    """The role of each part by name, or by colour such as #c81e1e, from a CSV with the columns
    part, role and attributes.

    Attributes, such as sharp, are separated by semicolons and may be left out.

    Raises:
        InputError: names the line and the column of the first mistake.
    """
    path = Path(path)
    roles: dict[str, PartRole] = {}
    for key, row in _rows(path):
        part = (row["part"] or "").strip()
        part = part.lower() if part.startswith("#") else part
        if not part:
            raise InputError(path, key, "names no part")
        if part.startswith("#") and not COLOUR.fullmatch(part):
            raise InputError(path, key, f"'{part}' is not a colour such as #c81e1e")
        if part in roles:
            raise InputError(path, key, f"'{part}' has a role already")
        words = (row.get(ATTRIBUTES) or "").split(";")
        attributes = [word.strip() for word in words if word.strip()]
        described = {"role": (row["role"] or "").strip(), ATTRIBUTES: attributes}
        roles[part] = PartRole.check(described, f"{path}: {key}")
    if not roles:
        raise InputError(path, "", "names no part")
    if len({part.startswith("#") for part in roles}) > 1:
        raise InputError(path, "part", "mixes names and colours of parts: use one of them")
    return RoleTable(path, roles)


def _rows(path: Path) -> list[tuple[str, dict[str, str | None]]]:
    """The rows of a CSV with the right columns, each with its line."""
    if not path.is_file():
        raise InputError(path, "", "no such file")
    with parsing(path, "cannot be read as CSV"):
        reader = csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines(), strict=True)
        rows = list(reader)
    columns, allowed = tuple(reader.fieldnames or ()), (*COLUMNS, ATTRIBUTES)
    for name in COLUMNS:
        if name not in columns:
            raise InputError(path, name, "this column is missing")
    for name in columns:
        if name not in allowed:
            raise InputError(path, str(name), f"unknown column; allowed: {', '.join(allowed)}")
    return [(f"line {number}", row) for number, row in enumerate(rows, start=2)]
