"""A user's own tasks: what the parameters must say before anything runs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.errors import InputError

# Pictures and features without a task go by this name.
RESERVED = "none"


def check_tasks(tasks: Mapping[str, Mapping[str, Any]], path: str | Path = "params.yaml") -> None:
    """Check what the schema cannot: every task looks different in a picture.

    Raises:
        InputError: naming the first wrong key.
    """
    shown: dict[int, str] = {}
    for name, task in tasks.items():
        if name == RESERVED:
            raise InputError(path, f"tasks.{name}", "stands for no task: choose another name")
        shift = task["colour_shift"]
        if shift in shown:
            message = f"{shift} is that of {shown[shift]} too: no picture could tell them apart"
            raise InputError(path, f"tasks.{name}.colour_shift", message)
        shown[shift] = name
