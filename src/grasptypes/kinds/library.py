"""The kinds of objects: their files, names and shapes."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.kinds.description import Kind, Materials
from grasptypes.kinds.names import DATA, MATERIALS, kind_names
from grasptypes.yaml_files import read_yaml


def read_kind(name: str, folder: Path = DATA) -> Kind:
    """One kind by name.

    Raises:
        InputError: there is no such kind, or it has a mistake.
    """
    groups = kind_names(folder)
    if name not in groups:
        raise InputError(folder, name, f"there is no such kind; there are: {', '.join(groups)}")
    path = folder / f"{groups[name]}.yaml"
    return check_kind(name, _content(path, path.resolve())[name], path)


def check_kind(name: str, content: object, path: Path) -> Kind:
    """The kind that a block of a file describes; raises InputError."""
    if not isinstance(content, dict):
        raise InputError(path, name, "is not a mapping")
    try:
        return Kind.check(content, path)
    except InputError as error:
        raise InputError(path, ".".join(filter(None, [name, error.key])), error.message) from error


@cache
def _content(path: Path, _: Path) -> dict[str, object]:
    """The content of a file, read once wherever the process is."""
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
