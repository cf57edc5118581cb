"""Reference scans of objects: an optional folder of `<object>.stl` named by the user."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grasptypes.errors import InputError

REFERENCES = "GRASPTYPES_REFERENCE_MESHES"


def reference_meshes(environment: Mapping[str, str]) -> list[Path]:
    """The scans in the folder named by the environment, sorted by name; empty if none is named.

    Raises:
        InputError: the path is not a folder of scans.
    """
    named = environment.get(REFERENCES, "")
    if not named:
        return []
    scans = sorted(Path(named).glob("*.stl"))
    if not scans:
        raise InputError(
            REFERENCES, "", f"names '{named}', which is not a folder of <object>.stl files"
        )
    return scans
