"""How people hold parts: the table in holds.yaml, and section `hold_fit`, its fit to labels."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Literal, Self

from pydantic import model_validator

from grasptypes.errors import InputError
from grasptypes.settings.base import (
    Many,
    MisplacedError,
    Name,
    Settings,
    Share,
    Unique,
    setting,
)
from grasptypes.settings.roles import RoleName
from grasptypes.settings.tasks import TASKS, Factor, Grip, Task
from grasptypes.yaml_files import read_yaml

HOLDS = Path(__file__).with_suffix(".yaml")
Measure = Literal["length", "width", "thickness", "compactness", "load_n"]


class HoldGroup(Settings):
    """Roles that people hold alike."""

    roles: Unique[RoleName] = setting("roles of the parts", min_length=1)
    grips: dict[Grip, Factor] = setting("prior of each grip, relative to the others", min_length=1)
    fitted: bool = setting("whether the priors are fitted to published labels")
    held_at: Literal["task", "centre_of_mass"] = setting(
        "where along its axis: where the task says, or near the centre of mass"
    )
    reason: str = setting("why, or the evidence", min_length=1)


class Fit(Settings):
    """How well grips fit by size or weight: a factor (measure / at) ** power from `at` upwards."""

    grips: Unique[Grip] = setting("grips it applies to", min_length=1)
    groups: Unique[Name] = setting("groups it applies to; empty: all", default=())
    measure: Measure = setting("what is measured")
    at: float = setting("value up to which the factor is 1", gt=0, le=100)
    expected: float = setting("exponent without any labels", ge=-10, le=10)
    power: float = setting(
        "exponent fitted to published labels; negative: the larger, the worse", ge=-10, le=10
    )
    reason: str = setting("why, or the evidence", min_length=1)


class HoldTable(Settings):
    """How people hold parts, by role, size and weight."""

    groups: dict[Name, HoldGroup] = setting("groups of roles", min_length=1)
    area_power: float = setting("exponent of a place's share of the surface", ge=0, le=2)
    rarest: Share = setting("grips that a smaller share of people would use are left out")
    fits: Many[Fit] = setting("how grips depend on size and weight")

    @model_validator(mode="after")
    def _names_agree(self) -> Self:
        group_of: dict[str, str] = {}
        for name, group in self.groups.items():
            for role in group.roles:
                other = group_of.setdefault(role, name)
                if other != name:
                    message = f"'{role}' is also in {other}"
                    raise MisplacedError(f"groups.{name}.roles", message)
        for index, fit in enumerate(self.fits):
            for name in fit.groups:
                if name not in self.groups:
                    message = f"'{name}' is not one of {', '.join(self.groups)}"
                    raise MisplacedError(f"fits.{index}.groups", message)
        return self


class TouchSettings(Settings):
    """How the contact of published poses is measured."""

    hand_spacing_m: float = setting(
        "distance between neighbouring points on the hand", ge=0.001, le=0.05
    )
    touch_m: float = setting("surfaces closer than this touch", gt=0, le=0.05)


class HoldFitSettings(Settings):
    """How the free numbers of the table of holds are fitted to published labels."""

    grasps: float = setting("grasps of an object and task that count as independent", gt=0, le=100)
    label_noise: Share = setting("share of grasps whose type says nothing")
    prior_sd: float = setting(
        "standard deviation of the priors' natural logarithms without labels", gt=0, le=10
    )
    power_sd: float = setting("standard deviation of the exponents without labels", gt=0, le=10)
    relatives: Many[Unique[str]] = setting("objects that are left out together")
    touch: TouchSettings


@cache
def read_hold_table(path: str | Path = HOLDS) -> HoldTable:
    """The table of holds.

    Raises:
        InputError: names the file and the key of the first mistake.
    """
    return HoldTable.check(read_yaml(path), path)


def check_tasks(tasks: Mapping[str, Task], table: HoldTable) -> None:
    """Check that the table says how to hold every role that a task touches.

    Raises:
        InputError: names the first task with a role that is in no group.
    """
    grouped = {role for group in table.groups.values() for role in group.roles}
    for name, task in tasks.items():
        for role in task.touched:
            if role not in grouped:
                message = f"'{role}' is in no group of {HOLDS.name}"
                raise InputError(TASKS, f"tasks.{name}.touched", message)
