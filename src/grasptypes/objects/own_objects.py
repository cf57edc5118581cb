"""A user's own objects: checks of their files, and that every object has a way to be held."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.settings.objects import ObjectSettings


def check_own_objects(objects: ObjectSettings, path: str | Path = "params.yaml") -> None:
    """Check that the files named by `objects.own` exist.

    Raises:
        InputError: names the key of the first missing file.
    """
    for name, own in objects.own.items():
        files = {f"contact_maps.{task}": file for task, file in own.contact_maps.items()}
        for key, file in {"file": own.file, **files}.items():
            if not Path(file).is_file():
                raise InputError(path, f"objects.own.{name}.{key}", f"no such file: {file}")


def measured_map(objects: ObjectSettings, name: str, task: str) -> str | None:
    """Path of the measured contact map of an own object for a task, if any."""
    return objects.own[name].contact_maps.get(task) if name in objects.own else None


def check_every_hold(
    objects: ObjectSettings,
    tasks: Collection[str],
    holds: Collection[tuple[str, str]],
    table: str | Path,
) -> None:
    """Check that every object has a way to be held for every task.

    Args:
        holds: the rows of the affinity table by object and task.
        table: path of the affinity table.

    Raises:
        InputError: names the first object and task with neither rows nor a measured map.
    """
    for name in [*objects.names, *objects.own]:
        for task in tasks:
            if (name, task) in holds or measured_map(objects, name, task):
                continue
            own = f" or set objects.own.{name}.contact_maps.{task}" if name in objects.own else ""
            raise InputError(table, f"{name} and {task}", f"has no row; add at least one{own}")
