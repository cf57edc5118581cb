"""What a row of the dataset says about how to repeat its grasp.

A robot opens the hand (pregrasp), moves it straight along its approach (touching), and closes it.
From the touching pose, the physics test computes the same again, to the last digit. The held state
is where the fingers ended; `stopped_joints` says which of them the TorqueSwitch had released.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand

Array = NDArray[np.float64]

# Columns of the dataset, and of the tables that it is made from.
STATE_COLUMNS = (
    "stopped_joints",
    "touching_pose",
    "touching_joints",
    "pregrasp_pose",
    "pregrasp_joints",
)


class RecordedGrasp(NamedTuple):
    """The states of one grasp; poses of the hand (4, 4) in the object's frame, joints (J,)."""

    T_object_pregrasp: Array
    pregrasp_positions: Array
    T_object_touching: Array
    touching_positions: Array
    T_object_held: Array
    held_positions: Array
    stages: tuple[int, ...]
    """Number of stopped joints of each finger, as held."""


def state_cells(table: pd.DataFrame) -> dict[str, list[str]]:
    """The columns of states as text; numbers keep all their digits."""
    return {name: [cell(numbers) for numbers in table[name]] for name in STATE_COLUMNS}


def cell(numbers: ArrayLike) -> str:
    """Numbers as the text of a cell, separated by commas, with all their digits."""
    return ",".join(repr(number) for number in np.asarray(numbers).tolist())


def recorded_grasp(row: Mapping[Any, Any], hand: Hand) -> RecordedGrasp:
    """The states in a row of the dataset."""
    pregrasp, touching = (_pose(row[f"{name}_pose"]) for name in ("pregrasp", "touching"))
    held = configuration.unpack(_numbers(row["HandConfiguration"])).T_object_hand
    return RecordedGrasp(
        *(pregrasp, _numbers(row["pregrasp_joints"])),
        *(touching, _numbers(row["touching_joints"])),
        *(held, np.array([row[name] for name in joint_columns(hand)], dtype=np.float64)),
        tuple(int(count) for count in str(row["stopped_joints"]).split(",")),
    )


def joint_columns(hand: Hand) -> list[str]:
    """Columns of the hand's joint positions."""
    return [f"{joint.name}_{'m' if joint.prismatic else 'rad'}" for joint in hand.joints]


def _numbers(text: str) -> Array:
    return np.array(text.split(","), dtype=np.float64)


def _pose(text: str) -> Array:
    T = np.eye(4)
    T[:3] = _numbers(text).reshape(3, 4)
    return T
