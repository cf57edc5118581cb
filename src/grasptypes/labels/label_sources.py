"""Objects and tasks of a label source: the published labels cover only the authors'."""

from __future__ import annotations

import csv
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from grasptypes.errors import InputError

SOURCES = ("simulated", "published")


@dataclass(frozen=True)
class Known:
    """Objects and tasks that have labels, in the order of the parameters."""

    objects: list[str]
    tasks: list[str]


def label_sources(
    used: Collection[str],
    counts: str | Path,
    objects: Collection[str],
    tasks: Collection[str],
    path: str | Path = "params.yaml",
) -> dict[str, Known]:
    """The labelled objects and tasks of each label source.

    Simulated labels cover every object and task. Published labels cover those of the authors: own
    objects, variants and further tasks are not included.

    Args:
        used: label sources to make tables for.
        counts: CSV of the published counts, one row per object and task.
        objects, tasks: of the parameters.
        path: of the parameters.

    Raises:
        InputError: published labels are used, but none of the objects and tasks have them.
    """
    with open(counts, encoding="utf-8", newline="") as file:
        rows = {(row["object"], row["task"]) for row in csv.DictReader(file)}
    known_tasks = [task for task in tasks if any((name, task) in rows for name in objects)]
    known = [name for name in objects if any((name, task) in rows for task in tasks)]
    if "published" in used and not known:
        message = "'published' has none of these objects and tasks; leave it out"
        raise InputError(path, "labels", message)
    return dict(zip(SOURCES, (Known([*objects], [*tasks]), Known(known, known_tasks)), strict=True))
