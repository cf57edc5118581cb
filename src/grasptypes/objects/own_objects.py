"""A user's own objects: checks of their files, and that every object has a way to be held."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.objects.part_roles import part_roles
from grasptypes.settings.objects import ObjectSettings
from grasptypes.settings.tasks import Task


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
    objects: ObjectSettings, tasks: Mapping[str, Task], path: str | Path = "params.yaml"
) -> None:
    """Check that every object whose roles are known has a way to be held for every task.

    Args:
        tasks: the tasks of the run.
        path: of the parameters, for errors.

    Raises:
        InputError: names the first object and task with neither a measured map nor a part with a
            role that the task touches.
    """
    for name in objects.names:
        for task, described in tasks.items():
            if not _touched(described) & {part.role for part in part_roles(name).values()}:
                roles = ", ".join(described.touched)
                message = f"{name} has no part that people touch for it (roles: {roles})"
                raise InputError(path, f"tasks.{task}", message)
    for name, own in objects.own.items():
        for task, described in tasks.items():
            known = {part.role for part in own.parts.values()}
            if task in own.contact_maps or not known or _touched(described) & known:
                continue  # without any role, the shape tells the roles
            raise InputError(
                path,
                f"objects.own.{name}",
                f"has no way to be held for {task}: give a part a role that {task} touches "
                f"(parts: {{body: {{role: {next(iter(described.touched))}}}}}), or set "
                f"contact_maps.{task}",
            )


def _touched(task: Task) -> set[str]:
    """Roles that people touch for a task."""
    return {role for role, weight in task.touched.items() if weight > 0}
