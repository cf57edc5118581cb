"""The predictors of the paper's Table I: what each sees of the task, and what it answers."""

from __future__ import annotations

from dataclasses import dataclass

TASK_LAYER = 2  # the layer at which the task vector enters (paper, section III-D)


@dataclass(frozen=True)
class Variant:
    """One row of Table I.

    Attributes:
        row: letter in the paper's table.
        picture_shows_task: the task is encoded as a colour shift of the image.
        task_vector: the task is appended to the input of a fully connected layer as a one-hot
            vector.
        joint_labels: the label contains the types of all tasks.
        frequencies: the probability vector is how often each type occurs, instead of the same for
            all types of the label.
        task_layer: the layer that the vector is appended to, from 1.
    """

    row: str
    picture_shows_task: bool
    task_vector: bool
    joint_labels: bool
    frequencies: bool = False
    task_layer: int = TASK_LAYER


VARIANTS = {
    "no_task": Variant("a", False, False, False),
    "task_vector": Variant("b", False, True, False),
    "task_in_image": Variant("c", True, False, False),
    "ignores_task": Variant("d", False, False, True),
    "e_mobilenet_v2": Variant("e", False, False, True, frequencies=True),
}
