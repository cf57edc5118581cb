"""Reading a release of the dataset."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from grasptypes.errors import InputError, parsing
from grasptypes.files import file_sha256
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand

CHECKSUMS, DESCRIPTION = "SHA256SUMS", "datapackage.json"
_TYPES = {"integer": "int64", "number": "float64", "string": "str"}


@dataclass(frozen=True)
class Release:
    """A release; its tables are described in its datapackage.json.

    Attributes:
        folder: where it is.
        version: of the package that wrote it.
        tables: by name: grasps, contacts, samples, folds, splits, objects, parts, views.
    """

    folder: Path
    version: str
    tables: dict[str, pd.DataFrame]

    @property
    def grasps(self) -> pd.DataFrame:
        """One row per grasp."""
        return self.tables["grasps"]

    @property
    def hand(self) -> Hand:
        """The hand of the grasps."""
        return load_hand(next(path.parent for path in self.folder.glob("hands/*/hand.yaml")))

    def mesh(self, name: str) -> Path:
        """GLB of an object; raises InputError if there is no such object."""
        path = self.folder / "objects" / f"{name}.glb"
        if not path.is_file():
            known = ", ".join(self.tables["objects"].Object)
            raise InputError(self.folder, name, f"there is no such object; it has {known}")
        return path


def load_release(path: str | Path) -> Release:
    """Read a release and check that every file is as it was written.

    Raises:
        InputError: the folder is no release, or names the first file that is missing, changed or
            differs from its description.
    """
    folder = Path(path)
    if not (folder / CHECKSUMS).is_file() or not (folder / DESCRIPTION).is_file():
        raise InputError(folder, "", f"is no release: {CHECKSUMS} or {DESCRIPTION} is missing")
    for line in (folder / CHECKSUMS).read_text(encoding="utf-8").splitlines():
        sha256, name = line.split("  ", 1)
        if not (folder / name).is_file():
            raise InputError(folder / name, "", "is missing")
        if file_sha256(folder / name) != sha256:
            raise InputError(folder / name, "", f"differs from its checksum in {CHECKSUMS}")
    with parsing(folder / DESCRIPTION, "is not the description of a release"):
        description = json.loads((folder / DESCRIPTION).read_text(encoding="utf-8"))
        tables = {
            each["name"]: _read_table(folder / each["path"], each["schema"]["fields"])
            for each in description["resources"]
            if "schema" in each
        }
        return Release(folder, str(description["version"]), tables)


def _read_table(path: Path, fields: list[dict[str, str]]) -> pd.DataFrame:
    types = {field["name"]: _TYPES[field["type"]] for field in fields}
    table = pd.read_csv(path, dtype=types, keep_default_na=False, na_values={})
    if list(table.columns) != list(types):
        raise InputError(path, "", f"its columns differ from {DESCRIPTION}")
    return table
