"""Names of kinds and of their shapes; only the keys of the kinds' files are read."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from grasptypes.errors import InputError

DATA = Path(__file__).with_name("data")
MATERIALS = "materials.yaml"
# A shape's name ends in its number.
SHAPE_PATTERN = r"[a-z][a-z0-9_]*_s\d\d"
_KEY = re.compile(r"^(\w+):", re.MULTILINE)


def shape_names(kind: str, count: int) -> list[str]:
    """Names of the first `count` shapes (at most 99) of a kind, such as mallet_s01."""
    return [f"{kind}_s{number:02d}" for number in range(1, count + 1)]


def shape_of(name: str) -> tuple[str, int]:
    """Kind and number of a shape.

    Raises:
        ValueError: no such name.
    """
    if not re.fullmatch(SHAPE_PATTERN, name):
        raise ValueError(f"'{name}' is no shape of a kind, such as mallet_s01")
    return name[:-4], int(name[-2:])


def kind_files(folder: Path = DATA) -> list[Path]:
    """The files of kinds, one per group."""
    return sorted(path for path in folder.glob("*.yaml") if path.name != MATERIALS)


def kind_names(folder: Path = DATA) -> dict[str, str]:
    """The group of each kind, by name.

    Raises:
        InputError: two groups have a kind of the same name.
    """
    groups: dict[str, str] = {}
    for path in kind_files(folder):
        for name in _KEY.findall(path.read_text(encoding="utf-8")):
            if groups.get(name, path.stem) != path.stem:
                raise InputError(path, name, f"is also in {groups[name]}.yaml")
            groups[name] = path.stem
    return groups


def kind_texts(folder: Path = DATA) -> dict[str, str]:
    """The block of each kind as written, by name."""
    texts: dict[str, str] = {}
    for path in kind_files(folder):
        text = path.read_text(encoding="utf-8")
        keys = list(_KEY.finditer(text))
        ends = [key.start() for key in keys[1:]] + [len(text)]
        texts |= {key[1]: text[key.start() : end] for key, end in zip(keys, ends, strict=True)}
    return texts


def check_names(names: Iterable[str], folder: Path = DATA) -> None:
    """Check that there are kinds of these names.

    Raises:
        InputError: there is no such kind.
    """
    known = kind_names(folder)
    for name in names:
        if name not in known:
            raise InputError(
                "params.yaml",
                "kinds.names",
                f"'{name}' is not a kind; there are: {', '.join(known)}",
            )
