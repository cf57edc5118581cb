"""How models are told one of many tasks: what the workflow's rules need of it."""

from __future__ import annotations

from collections.abc import Sequence

# How each model is told the task, in words.
MODELS = {
    "no_task": "(a) no task",
    "task_vector": "(b) one-hot vector",
    "task_in_image": "(c) colour shift",
    "film": "FiLM, embedding of the task",
    "affordance_vector": "affordance vector",
    "film_affordance": "FiLM, affordance vector",
    "demonstration": "(f) demonstration",
}
# A task that was not learnt from can be described or shown; it has no place in a one-hot vector, no
# embedding, and no colour.
UNSEEN_TASK_MODELS = ("no_task", "affordance_vector", "film_affordance", "demonstration")

# The paper shifts all colours up for one task and down for the other: two opposite corners of a
# cube. Further tasks have its other corners, opposite ones in turn, so that every channel changes
# by as much as in the paper.
CORNERS = (
    (1, 1, 1),
    (-1, -1, -1),
    (1, 1, -1),
    (-1, -1, 1),
    (1, -1, 1),
    (-1, 1, -1),
    (-1, 1, 1),
    (1, -1, -1),
)


def corner_shifts(tasks: Sequence[str], size: int) -> dict[str, tuple[int, int, int]]:
    """The colour shift (red, green, blue) of each of up to eight tasks, all of the same size."""
    corners = CORNERS[: len(tasks)]
    return {
        task: (red * size, green * size, blue * size)
        for task, (red, green, blue) in zip(tasks, corners, strict=True)
    }
