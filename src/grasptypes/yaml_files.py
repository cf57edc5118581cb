"""Strict reading of YAML files: no tags, no duplicate keys, only text keys."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from grasptypes.errors import InputError

# Far more levels than any parameter needs.
DEEPEST = 100
if TYPE_CHECKING:
    from yaml import SafeLoader as _SafeLoader
else:
    # libyaml is several times faster; a PyYAML without it gives the same result.
    _SafeLoader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _StrictLoader(_SafeLoader):
    """A safe loader that accepts only unique text keys; in plain YAML the last duplicate wins."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        """A mapping with unique text keys."""
        seen = set()
        for key_node, _ in node.value:
            problem, kind = "", key_node.tag.split(":")[-1]
            if kind == "merge":
                problem = "'<<' is not supported: write the keys out"
            elif kind != "str":
                problem = f"a key must be text (quote it), not {kind}"
            elif key_node.value in seen:
                problem = f"duplicate key '{key_node.value}'"
            if problem:
                raise yaml.constructor.ConstructorError(None, None, problem, key_node.start_mark)
            seen.add(key_node.value)
        return super().construct_mapping(node, deep)

    def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
        """A value; one that does not fit its type is an error with a line number."""
        try:
            return super().construct_object(node, deep)
        except (ValueError, KeyError, AttributeError) as error:  # such as 2020-99-99, !!bool x
            problem = f"'{node.value}' is not a valid {node.tag.split(':')[-1]}"
            raise yaml.constructor.ConstructorError(None, None, problem, node.start_mark) from error


def read_yaml(path: str | Path) -> dict[str, Any]:
    """Read a YAML mapping; tags, duplicate keys and anything but a mapping are rejected.

    Raises:
        InputError: the file is missing, not YAML, or not a mapping.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
        _check_depth(path, text)
        content = yaml.load(text, _StrictLoader)
    except FileNotFoundError as error:
        raise InputError(path, "", "no such file") from error
    except IsADirectoryError as error:
        raise InputError(path, "", "is a folder") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "", f"not UTF-8 text: {error}") from error
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f"line {mark.line + 1}" if mark else ""
        problem = getattr(error, "problem", None) or str(error)
        raise InputError(path, line, f"not valid YAML: {problem}") from error
    if not isinstance(content, dict):
        raise InputError(path, "", "must contain a mapping of sections, such as 'objects:'")
    return content


def merge(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """``base`` updated recursively with ``changes``; lists are replaced as a whole."""
    merged = dict(base)
    for key, value in changes.items():
        old = merged.get(key)
        if isinstance(value, Mapping) and isinstance(old, Mapping):
            value = merge(old, value)
        merged[key] = value
    return merged


def _check_depth(path: Path, text: str) -> None:
    """Reject nesting that would overflow the stack of libyaml's loader; its events use no stack."""
    depth = 0
    for event in yaml.parse(text, _SafeLoader):
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        if depth > DEEPEST:
            raise InputError(path, "", f"not valid YAML: nested more than {DEEPEST} levels deep")
