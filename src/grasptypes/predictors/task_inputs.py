"""Inputs that tell a model one of many tasks: a one-hot vector, a colour, or what it needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import get_args

import numpy as np
import torch

from grasptypes.predictors.backbone import Backbone
from grasptypes.predictors.features import for_inference, forward
from grasptypes.predictors.general_inputs import task_vector
from grasptypes.settings.roles import read_roles
from grasptypes.settings.tasks import Direction, Task, read_tasks


def shifted_features(
    backbone: Backbone,
    pictures: np.ndarray,
    shifts: Mapping[str, tuple[int, int, int]],
    batch: int,
) -> dict[str, np.ndarray]:
    """Features of images whose channels are shifted by different amounts.

    Args:
        pictures: (N, H, W, 3) uint8.
        shifts: of each task.
        batch: images per batch.

    Returns:
        task to (N, F) float32.
    """
    backbone = for_inference(backbone)
    found = {}
    for task, shift in shifts.items():
        shifted = np.clip(pictures.astype(np.int16) + np.array(shift, dtype=np.int16), 0, 255)
        chunks = torch.split(torch.from_numpy(shifted.astype(np.uint8)), batch)
        found[task] = torch.cat([forward(backbone, chunk) for chunk in chunks]).numpy()
    return found


def one_hot(tasks: Sequence[str]) -> np.ndarray:
    """(T, T) float32, one row per task."""
    return np.eye(len(tasks), dtype=np.float32)


def affordance_vectors(tasks: Sequence[Task]) -> np.ndarray:
    """What each task needs, so that a model can be told a task that it has not learnt from.

    For each role, how likely people touch it, whether it stays free, and whether the task's loads
    act on it; how hazards, the place along a handle, and grips count; the share of the loads in
    each direction, and the largest force, relative to the largest one of the whole table.

    Returns:
        (T, D) float32 between 0 and 1.
    """
    roles, directions = list(read_roles().roles), get_args(Direction)
    largest_n = max(load.force_n for task in read_tasks().values() for load in task.wrenches)
    rows = []
    for task in tasks:
        loads = task.wrenches
        loaded = {role for load in loads for role in load.at}
        # Roles that bear loads stand beside those that are touched or stay free.
        known = np.insert(task_vector(task), 2 * len(roles), [role in loaded for role in roles])
        along = [np.mean([load.along == way for load in loads]) for way in directions]
        rows.append([*known, *along, max(load.force_n for load in loads) / largest_n])
    return np.array(rows, dtype=np.float32)
