"""Sections `many_tasks` and `learning_curve`: more tasks than two, and fewer images."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from grasptypes.settings.base import MisplacedError, Name, Settings, Unique, setting
from grasptypes.settings.tasks import TASKS, read_tasks


def _is_a_task(name: str) -> str:
    if name not in read_tasks():
        raise ValueError(f"'{name}' is not described in {TASKS.name}: {', '.join(read_tasks())}")
    return name


class ManyTaskSettings(Settings):
    """Numbers of tasks, and how models are told them."""

    tasks: Unique[Annotated[Name, AfterValidator(_is_a_task)]] = setting(
        "tasks of tasks.yaml, of which the first are compared", min_length=3, max_length=8
    )
    numbers: Unique[Annotated[int, Field(ge=2)]] = setting("numbers of tasks", min_length=1)
    views: int = setting("images of each object", ge=5, le=1000)
    embedding: int = setting("numbers that stand for a task in FiLM", ge=1, le=256)
    least_grasps: int = setting("pairs with fewer valid grasps are left out", ge=1, le=100)

    @model_validator(mode="after")
    def _has_as_many_tasks(self) -> Self:
        if max(self.numbers) > len(self.tasks):
            raise MisplacedError("numbers", f"there are only {len(self.tasks)} tasks")
        return self


class LearningCurveSettings(Settings):
    """Models that learn from fewer images."""

    views: Unique[Annotated[int, Field(ge=1)]] = setting(
        "training images of each object", min_length=2
    )
    models: Unique[
        Literal["no_task", "task_vector", "task_in_image", "ignores_task", "e_mobilenet_v2"]
    ] = setting("models of Table I", min_length=1)
