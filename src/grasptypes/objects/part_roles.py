"""What the parts of the catalogue's objects are for, without building the objects."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from grasptypes.settings.roles import PartRole
from grasptypes.yaml_files import read_yaml

CATALOGUE = Path(__file__).with_name("catalogue.yaml")


@cache
def read_catalogue() -> dict[str, Any]:
    """The content of catalogue.yaml, which must not be changed."""
    return read_yaml(CATALOGUE)


def part_roles(name: str) -> dict[str, PartRole]:
    """The role of each part of a catalogue object by the part's name.

    Raises:
        InputError: names the object, the part and the wrong key.
    """
    return {
        part: PartRole.check(
            {key: value for key, value in described.items() if key in PartRole.model_fields},
            f"{CATALOGUE}: {name}.parts.{part}",
        )
        for part, described in read_catalogue()[name]["parts"].items()
    }
