"""Which objects afford which tasks, by the roles of their parts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from grasptypes.objects.part_roles import part_roles
from grasptypes.settings.tasks import TASKS, Task, read_tasks


def affords(roles: Iterable[str], task: Task) -> bool:
    """Whether an object with such parts can be grasped for a task."""
    own = set(roles)
    needed = not task.requires or own & set(task.requires)
    return bool(needed and own & set(task.touched))


def afforded(
    objects: Sequence[str], tasks: Sequence[str], table: str | Path = TASKS
) -> list[tuple[str, str]]:
    """Catalogue objects and the tasks that they afford, in the given order.

    Args:
        tasks: names in the table.

    Raises:
        InputError: the table or the catalogue has a mistake.
    """
    known = read_tasks(table)
    pairs = []
    for name in objects:
        roles = [part.role for part in part_roles(name).values()]
        pairs += [(name, task) for task in tasks if affords(roles, known[task])]
    return pairs
