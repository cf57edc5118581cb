"""Demonstrations of tasks: the table demonstrations.yaml, and section `demonstrations`."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from grasptypes.errors import InputError
from grasptypes.settings.base import (
    Many,
    MisplacedError,
    Name,
    Settings,
    Share,
    Triple,
    setting,
)
from grasptypes.settings.general import ViewDraws
from grasptypes.settings.renders import RenderSheet
from grasptypes.yaml_files import read_yaml

DEMONSTRATIONS = Path(__file__).with_suffix(".yaml")
# In the table of a task, all objects that it does not name.
ANY = "any"


class Body(Settings):
    """A simple shape that stands where an object acts."""

    shape: Literal["ball", "box", "cylinder"] = setting("a cylinder's axis is z")
    size_m: Triple[Annotated[float, Field(gt=0, le=2)]] = setting("extents before it is turned")
    at_m: Triple[float] = setting("centre")
    turn_deg: Triple[float] = setting("turns about x, y and z in turn", default=(0.0, 0.0, 0.0))
    rgb: Triple[Share] = setting("linear colour")


class Action(Settings):
    """A way of using objects, and what is around: x is ahead, z up, the object acts at 0."""

    meaning: str = setting("what happens, in words", min_length=1)
    acts: Literal["ahead", "down"] = setting("where the object acts")
    bodies: Many[Body] = setting("what stands there", min_length=1)


class Use(Settings):
    """How an object is used; directions are in its own frame."""

    action: Name = setting("of the table")
    part: Name | Literal[""] = setting("part of the object that acts; empty: all of it")
    ahead: Triple[float] = setting("points ahead")
    up: Triple[float] = setting("points up")
    round: bool = setting("may be turned about z, so that the hand is behind", default=False)

    @model_validator(mode="after")
    def _has_two_directions(self) -> Self:
        lengths = math.hypot(*self.ahead), math.hypot(*self.up)
        along = sum(a * b for a, b in zip(self.ahead, self.up, strict=True))
        if min(lengths) < 0.9 or max(lengths) > 1.1 or abs(along) > 0.1:
            raise MisplacedError("up", "must be across `ahead`, and both of length 1")
        return self


class DemonstrationTable(Settings):
    """Actions by name, and uses by object."""

    actions: dict[Name, Action] = setting("actions by name", min_length=1)
    uses: dict[Name, Use] = setting("use of each object", min_length=1)
    tasks: dict[Name, dict[Name, Use]] = setting("the same for other tasks, by task and object")

    @model_validator(mode="after")
    def _knows_actions(self) -> Self:
        for key, uses in {"uses": self.uses, **self.tasks}.items():
            for name, use in uses.items():
                if use.action not in self.actions:
                    message = f"'{use.action}' is not one of {', '.join(self.actions)}"
                    path = key if key == "uses" else f"tasks.{key}"
                    raise MisplacedError(f"{path}.{name}.action", message)
        return self

    def use_of(self, name: str, task: str, path: str | Path = DEMONSTRATIONS) -> Use:
        """How an object is shown at a task that is not handing it over.

        Raises:
            InputError: the table does not say it, neither for the object nor for any.
        """
        uses = self.uses if task == "use" else self.tasks.get(task, {})
        if name not in uses and ANY not in uses:
            key = "uses" if task == "use" else f"tasks.{task}"
            raise InputError(path, f"{key}.{name}", "is missing")
        return uses.get(name) or uses[ANY]


@cache
def read_demonstrations(path: str | Path = DEMONSTRATIONS) -> DemonstrationTable:
    """The table.

    Raises:
        InputError: names the file and the key of the first mistake.
    """
    return DemonstrationTable.check(read_yaml(path), path)


class SceneSettings(Settings):
    """Images of objects that are used or handed over."""

    views: int = setting("images of each object and task", ge=5, le=1000)
    grasps: int = setting("grasps of each object and task that are shown", ge=1, le=1000)
    handover_m: float = setting("gap between the hands, or hand and object", ge=0, le=1)
    view: ViewDraws


class DemonstrationSettings(SceneSettings):
    """Such images as the input that tells a task."""

    missing: Share = setting("share of the training examples without a demonstration")
    sheet: RenderSheet
