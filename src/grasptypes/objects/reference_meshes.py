"""Scans to measure objects by: a folder of `<object>.stl` that the user names, if there is one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grasptypes.errors import InputError

REFERENCES = "GRASPTYPES_REFERENCE_MESHES"


def reference_meshes(environment: Mapping[str, str]) -> list[Path]:
    """The scans in the folder that the environment names, by name; none if it names none.

    Raises:
        InputError: what is named is no folder of scans.
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
