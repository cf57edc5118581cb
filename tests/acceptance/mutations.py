"""Every value of params.yaml, every module, script and asset, changed once."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from grasptypes.errors import InputError
from grasptypes.settings.params import Params

Key = tuple[str | int, ...]


class Mutation(NamedTuple):
    """A file with other content.

    Attributes:
        name: the parameter's dotted key, or the file's path.
        file: relative to the repository.
        content: what it is to hold.
    """

    name: str
    file: str
    content: str


def of_parameters(
    root: Path, special: Mapping[str, Any], left_out: Collection[str]
) -> Iterator[Mutation]:
    """Every leaf of params.yaml with another allowed value.

    Args:
        special: values for keys that cannot be guessed, by dotted key.
        left_out: keys that are not to be changed.
    """
    params = yaml.safe_load((root / "params.yaml").read_text())
    for key in leaves(params):
        name = ".".join(map(str, key))
        if name in left_out:
            continue
        old = _get(params, key)
        tries = [special[name]] if name in special else _others(old)
        for value in tries:
            changed = _with(params, key, value)
            if value != old and _is_allowed(changed):
                yield Mutation(name, "params.yaml", yaml.safe_dump(changed, sort_keys=False))
                break
        else:
            raise AssertionError(f"{name}: no other value than {old!r} is allowed; name one")


def leaves(value: Any, key: Key = ()) -> Iterator[Key]:
    """Keys of all values that are neither a mapping nor a list of mappings."""
    if isinstance(value, Mapping) and value:
        for name, part in value.items():
            yield from leaves(part, (*key, name))
    elif isinstance(value, list) and value and isinstance(value[0], Mapping):
        for number, part in enumerate(value):
            yield from leaves(part, (*key, number))
    else:
        yield key


def of_code(root: Path, folder: str) -> Iterator[Mutation]:
    """Every Python file below a folder with one more statement."""
    for path in sorted((root / folder).rglob("*.py")):
        name = str(path.relative_to(root))
        yield Mutation(name, name, path.read_text() + "\n_MUTATED = 1\n")


def _others(old: Any) -> list[Any]:
    """Values near the old one; for a list, the list with such a value in one place."""
    if isinstance(old, bool):
        return [not old]
    if isinstance(old, int):
        return [old + 1, old - 1, old // 2, float(old) * 0.99]
    if isinstance(old, float):
        return [old * 0.99, old * 1.01, old + 0.01]
    if isinstance(old, list):
        places = range(len(old) - 1, -1, -1)
        return [[*old[:i], new, *old[i + 1 :]] for i in places for new in _others(old[i])]
    return []


def _get(params: Any, key: Key) -> Any:
    for part in key:
        params = params[part]
    return params


def _with(params: Any, key: Key, value: Any) -> Any:
    """A copy of nested mappings and lists with one value replaced."""
    if not key:
        return value
    first, *rest = key
    copy = list(params) if isinstance(params, list) else dict(params)
    copy[first] = _with(params[first], tuple(rest), value)
    return copy


def _is_allowed(params: Any) -> bool:
    try:
        Params.check(params)
    except InputError:
        return False
    return True
