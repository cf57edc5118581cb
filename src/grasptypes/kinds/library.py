"""The kinds of objects: their files, names and shapes."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.kinds.description import Kind, Materials
from grasptypes.yaml_files import read_yaml

DATA = Path(__file__).with_name("data")
MATERIALS = "materials.yaml"
_SHAPE = re.compile(r"(.+)_s(\d\d)")


def shape_names(kind: str, count: int) -> list[str]:
    """Names of the first `count` shapes (at most 99) of a kind, such as mallet_s01."""
    return [f"{kind}_s{number:02d}" for number in range(1, count + 1)]


def shape_of(name: str) -> tuple[str, int]:
    """Kind and number of a shape.

    Raises:
        ValueError: no such name.
    """
    found = _SHAPE.fullmatch(name)
    if not found:
        raise ValueError(f"'{name}' is no shape of a kind, such as mallet_s01")
    return found[1], int(found[2])


def kind_files(folder: Path = DATA) -> list[Path]:
    """The files of kinds, one per group."""
    return sorted(path for path in folder.glob("*.yaml") if path.name != MATERIALS)


def kind_names(folder: Path = DATA) -> dict[str, str]:
    """The group of each kind, by name; only the keys of the files are read."""
    groups: dict[str, str] = {}
    for path in kind_files(folder):
        for name in re.findall(r"^(\w+):", path.read_text(encoding="utf-8"), re.MULTILINE):
            if name in groups:
                raise InputError(path, name, f"is also in {groups[name]}.yaml")
            groups[name] = path.stem
    return groups


def read_kind(name: str, folder: Path = DATA) -> Kind:
    """One kind by name.

    Raises:
        InputError: there is no such kind, or it has a mistake.
    """
    groups = kind_names(folder)
    if name not in groups:
        raise InputError(folder, name, f"there is no such kind; there are: {', '.join(groups)}")
    path = folder / f"{groups[name]}.yaml"
    return check_kind(name, _content(path)[name], path)


def check_kind(name: str, content: object, path: Path) -> Kind:
    """The kind that a block of a file describes; raises InputError."""
    if not isinstance(content, dict):
        raise InputError(path, name, "is not a mapping")
    try:
        return Kind.check(content, path)
    except InputError as error:
        raise InputError(path, ".".join(filter(None, [name, error.key])), error.message) from error


@cache
def _content(path: Path) -> dict[str, object]:
    return read_yaml(path)


@cache
def read_materials(folder: Path = DATA) -> Materials:
    """The materials and colours that kinds name."""
    return Materials.check(read_yaml(folder / MATERIALS), folder / MATERIALS)


def families(names: Iterable[str], folder: Path = DATA) -> dict[str, list[str]]:
    """The kinds of each family; all of one family are held out together."""
    found: dict[str, list[str]] = {}
    for name in names:
        found.setdefault(read_kind(name, folder).family, []).append(name)
    return found
