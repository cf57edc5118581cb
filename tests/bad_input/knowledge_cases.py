"""Mistakes in the data about roles, tasks and holds, and in the roles of a user's own parts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import yaml
from case import PARAMS, Case, library, start

from grasptypes.settings.holds import HOLDS, read_hold_table
from grasptypes.settings.roles import ROLES, read_roles
from grasptypes.settings.tasks import TASKS, read_tasks
from grasptypes.yaml_files import merge

READERS: dict[str, tuple[Path, Callable[[str], object]]] = {
    "roles.yaml": (ROLES, read_roles),
    "tasks.yaml": (TASKS, read_tasks),
    "holds.yaml": (HOLDS, read_hold_table),
}
BOX = {"file": "box.stl", "unit": "mm", "mass_kg": 0.1}


def changed(name: str, what: str, old: str, new: str, *names: str) -> Case:
    """A file that comes with the package, with one text replaced."""
    source, read = READERS[name]
    content = source.read_text(encoding="utf-8")
    assert old in content, (name, old)
    files = {name: content.replace(old, new, 1)}
    # Cached by path, so that no case sees another's file.
    return Case(name, what, files, library(uncached(read), name), (name, *names))


def uncached(read: Callable[[str], object]) -> Callable[[str], object]:
    """The reader without its memory of paths."""
    return read.__wrapped__  # type: ignore[attr-defined, no-any-return]


def own(what: str, block: dict[str, object], *names: str) -> Case:
    """Parts of a user's own object, in params.yaml."""
    content = yaml.safe_dump(merge(PARAMS, {"objects": {"own": {"box": BOX | block}}}))
    files = {"params.yaml": content, "box.stl": b"mesh"}
    return Case("params.yaml", what, files, start, ("params.yaml", "objects.own.box", *names))


CASES = [
    changed(
        *("roles.yaml", "no meaning", '{meaning: "what the object stands on"', '{meaning: ""'),
        *("roles.base.meaning", "is empty"),
    ),
    changed(
        *("roles.yaml", "an unknown attribute", "attributes: [sharp]", "attributes: [pointy]"),
        *("roles.blade.attributes", "'pointy'", "sharp"),
    ),
    changed("roles.yaml", "an unknown section", "roles:", "rolls:", "'rolls'", "attributes, roles"),
    changed(
        *("tasks.yaml", "an unknown role", "touched: {handle:", "touched: {hilt:"),
        *("tasks.use.touched", "'hilt'", "handle"),
    ),
    changed("tasks.yaml", "a negative weight", "grip_body: 1.0", "grip_body: -1", "tasks.use"),
    changed("tasks.yaml", "an unknown grip", "grips: {}", "grips: {hug: 2}", "'hug'", "wrap"),
    changed(
        *("tasks.yaml", "a position upside down", "[0.3, 0.8]", "[0.8, 0.3]"),
        *("tasks.use.position", "0.8 is above 0.3"),
    ),
    changed("tasks.yaml", "no reason", "reason: The edge must", "x: The edge must", "'x'"),
    changed(
        *("tasks.yaml", "a force in kilonewtons", "force_n: 20.0", "force_kn: 0.02"),
        *("tasks.cut.wrenches.0", "'force_kn'", "force_n"),
    ),
    changed(
        *("tasks.yaml", "an unknown direction", "along: axis", "along: up"),
        *("tasks.use.wrenches.1.along", "'up'", "across"),
    ),
    changed("holds.yaml", "a prior of -1", "tripod: 1.13", "tripod: -1", "groups.handle.grips"),
    changed("holds.yaml", "a prior that is not a number", "{wrap: 5.41", "{wrap: .nan", "groups"),
    changed("holds.yaml", "an unknown measure", "measure: width", "measure: girth", "'girth'"),
    changed("holds.yaml", "a size of 0", "at: 0.3", "at: 0", "fits.2.at", "greater than 0"),
    changed(
        *("holds.yaml", "an unknown group", "groups: [handle]", "groups: [hilt]"),
        *("fits.1.groups", "'hilt'", "handle"),
    ),
    changed(
        *("holds.yaml", "a role in two groups", "[stem, neck]", "[stem, handle]"),
        *("groups.slender.roles", "'handle' is also in handle"),
    ),
    own("an unknown role", {"parts": {"body": {"role": "hilt"}}}, "parts.body.role", "'hilt'"),
    own(
        *("a role that nobody touches", {"parts": {"body": {"role": "screen"}}}),
        *("held for", "contact_maps."),
    ),
]
