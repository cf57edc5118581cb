"""A user's own objects and tasks: what the parameters must say before anything runs."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from grasptypes.errors import InputError


def check_own_objects(
    objects: Mapping[str, Any], tasks: Collection[str], path: str | Path = "params.yaml"
) -> None:
    """Check what the schema cannot: names, tasks and files of the blocks `objects.own`.

    Args:
        objects: the section `objects` of the parameters.
        tasks: names of all tasks.
        path: of the parameters.

    Raises:
        InputError: naming the first wrong key.
    """
    if not objects["names"] and not objects["own"]:
        raise InputError(path, "objects.names", "is empty, and so is objects.own: name an object")
    for name, own in objects["own"].items():
        key = f"objects.own.{name}"
        if name in objects["names"]:
            raise InputError(path, key, "is also in objects.names: choose another name")
        maps = own.get("contact_maps", {})
        for task in maps:
            if task not in tasks:
                allowed = ", ".join(tasks)
                raise InputError(path, f"{key}.contact_maps", f"'{task}' is not one of {allowed}")
        files = {"file": own["file"]} | {
            f"contact_maps.{task}": file for task, file in maps.items()
        }
        for where, file in files.items():
            if not Path(file).is_file():
                raise InputError(path, f"{key}.{where}", f"no such file: {file}")


def measured_map(objects: Mapping[str, Any], name: str, task: str) -> str | None:
    """Path of the contact map measured on an own object for a task, if there is one."""
    return objects["own"].get(name, {}).get("contact_maps", {}).get(task)


def check_every_hold(
    objects: Mapping[str, Any],
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
    for name in [*objects["names"], *objects["own"]]:
        for task in tasks:
            if (name, task) in holds or measured_map(objects, name, task):
                continue
            own = (
                f" or set objects.own.{name}.contact_maps.{task}" if name in objects["own"] else ""
            )
            raise InputError(table, f"{name} and {task}", f"has no row; add at least one{own}")
