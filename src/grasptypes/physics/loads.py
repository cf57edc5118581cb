"""The load that a task puts on a grasped object besides its weight, from the task's wrenches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.settings.tasks import Direction, Task, Wrench

Array = NDArray[np.float64]


class TaskLoad(NamedTuple):
    """A force on an object, in one or several directions in turn."""

    point_m: Array
    """(3,) where it acts, in the object's frame."""
    force_n: float
    along: Direction
    axes: Array
    """(3, 3) rows: the object's principal axes, the longest one first, in its frame."""

    def forces(self, T_object_hand: Array) -> Array:
        """(K, 3) newtons, in the frame of a hand at a pose (4, 4)."""
        if self.along == "away":
            return self.force_n * np.array([[0.0, 0.0, 1.0]])
        if self.along == "down":
            directions = np.array([[0.0, 0.0, -1.0]])
        else:
            chosen = {"axis": self.axes[:1], "across": self.axes[1:], "any": self.axes}[self.along]
            directions = np.concatenate([chosen, -chosen])
        return np.asarray(self.force_n * directions @ T_object_hand[:3, :3])


def task_load(task: Task, geometry: ObjectGeometry, gravity_m_s2: float) -> TaskLoad:
    """The load of a task on an object: the first of the task's wrenches whose part it has.

    It acts at the centre of these parts, or at the centre of mass.
    """
    body = geometry.properties
    wrench, parts = _wrench(task.wrenches, body.roles)
    point_m = np.array(body.centre_of_mass_m)
    if parts:
        surface = geometry.surface
        numbers = [surface.part_names.tolist().index(part) for part in parts]
        point_m = surface.vertices[np.isin(surface.part_index, numbers)].mean(axis=0)
    _, axes = np.linalg.eigh(np.array(body.inertia_kg_m2))
    force_n = wrench.force_n + wrench.weights * body.mass_kg * gravity_m_s2
    return TaskLoad(point_m, force_n, wrench.along, axes.T)


def _wrench(
    wrenches: Sequence[Wrench], roles: Mapping[str, Mapping[str, object]]
) -> tuple[Wrench, list[str]]:
    """The wrench, and the names of the parts on which it acts; none for the centre of mass."""
    for wrench in wrenches[:-1]:
        if parts := [name for name, part in roles.items() if part["role"] in wrench.at]:
            return wrench, parts
    last = wrenches[-1]
    return last, [name for name, part in roles.items() if part["role"] in last.at]
