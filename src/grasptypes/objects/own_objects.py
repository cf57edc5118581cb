"""A user's own objects: the files they name, and that every object is held somehow."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.settings.objects import ObjectSettings


def check_own_objects(objects: ObjectSettings, path: str | Path = "params.yaml") -> None:
    """Check that the files that `objects.own` names are there.

    Raises:
        InputError: naming the key of the first that is not.
    """
    for name, own in objects.own.items():
        files = {f"contact_maps.{task}": file for task, file in own.contact_maps.items()}
        for key, file in {"file": own.file, **files}.items():
            if not Path(file).is_file():
                raise InputError(path, f"objects.own.{name}.{key}", f"no such file: {file}")


def measured_map(objects: ObjectSettings, name: str, task: str) -> str | None:
    """Path of the contact map measured on an own object for a task, if there is one."""
    return objects.own[name].contact_maps.get(task) if name in objects.own else None


def check_every_hold(
    objects: ObjectSettings,
    tasks: Collection[str],
    holds: Collection[tuple[str, str]],
    table: str | Path,
) -> None:
    """Check that every object is known to be held somehow for every task.

    Args:
        holds: object and task of the affinity table's rows.
        table: path of the affinity table.

    Raises:
        InputError: naming the first object and task without rows and without a measured map.
    """
    for name in [*objects.names, *objects.own]:
        for task in tasks:
            if (name, task) in holds or measured_map(objects, name, task):
                continue
            own = f" or set objects.own.{name}.contact_maps.{task}" if name in objects.own else ""
            raise InputError(table, f"{name} and {task}", f"has no row; add at least one{own}")
