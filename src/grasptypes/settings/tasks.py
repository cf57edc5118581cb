"""What objects are grasped for: the tasks in tasks.yaml, in terms of roles."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from grasptypes.settings.base import Name, Pair, Settings, Share, Unique, setting
from grasptypes.settings.roles import RoleName
from grasptypes.yaml_files import read_yaml

TASKS = Path(__file__).with_suffix(".yaml")
Grip = Literal["wrap", "enclose", "tripod", "pinch", "rim"]
Direction = Literal["axis", "across", "any", "down", "away"]
Factor = Annotated[float, Field(ge=0, le=100)]


def _upwards(values: tuple[float, float]) -> tuple[float, float]:
    low, high = values
    if low > high:
        raise ValueError(f"{low:g} is above {high:g}: give the smaller one first")
    return values


class Wrench(Settings):
    """A load that a task puts on the object, besides its weight."""

    at: Unique[RoleName] = setting("roles of the parts it acts on; empty: the centre of mass")
    force_n: float = setting("force", default=0.0, ge=0, le=1000)
    weights: float = setting(
        "force in weights of the object, added to it", default=0.0, ge=0, le=100
    )
    along: Direction = setting(
        "axis: the object's longest axis, to and fro; across: both others; any: all three; "
        "down: -z of the object; away: from the palm"
    )
    reason: str = setting("where the numbers come from", min_length=1)


class Task(Settings):
    """What an object is grasped for."""

    meaning: str = setting("what happens, in words", min_length=1)
    requires: Unique[RoleName] = setting(
        "roles of which an object needs one to afford the task; empty: every object does"
    )
    touched: dict[RoleName, Factor] = setting(
        "how likely people hold parts of a role, relative to each other", min_length=1
    )
    hazard: Share = setting("factor on hazardous parts")
    free: Unique[RoleName] = setting("roles of parts that no hand may cover")
    position: Annotated[Pair[Share], AfterValidator(_upwards)] = setting(
        "where along a handle people hold it: 0 next to what stays free, 1 at the far end"
    )
    grips: dict[Grip, Factor] = setting("factors on grips, where not 1")
    wrenches: list[Wrench] = setting(
        "loads besides the weight: the first one counts that acts on a part of the object",
        min_length=1,
    )
    reason: str = setting("why people hold objects this way for it", min_length=1)


class TaskTable(Settings):
    """All tasks by name."""

    tasks: dict[Name, Task] = setting("tasks by name", min_length=1)


@cache
def read_tasks(path: str | Path = TASKS) -> dict[str, Task]:
    """The tasks by name.

    Raises:
        InputError: names the file and the key of the first mistake.
    """
    return TaskTable.check(read_yaml(path), path).tasks
