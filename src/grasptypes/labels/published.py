"""The authors' published dataset: one labelled grasp per object, task and session."""

import csv
import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.hands import configuration
from grasptypes.labels.grasp_type import GRASP_TYPES

TASKS = ("handoff", "use")

# Published numbers have six digits; a pose further from a rigid one is not a rounding error.
RIGID_TOLERANCE = 1e-3
# A pose and four degrees of freedom: spread and three fingers.
CONFIGURATION_LENGTH = configuration.POSE_LENGTH + 4
# Beyond these a unit is wrong: published palms are within 0.2 m, their joints within half a turn.
FARTHEST_PALM_M = 2.0
LARGEST_ANGLE_RAD = 2 * np.pi


def _whole(text: str) -> int:
    if not text.lstrip("-").isdecimal():
        raise ValueError(f"{text!r} is not an integer")
    return int(text)


def _count(text: str) -> int:
    if _whole(text) < 1:
        raise ValueError(f"{text} is not a positive integer")
    return int(text)


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError as error:
        raise ValueError(f"{text!r} is not a number") from error
    if not np.isfinite(number):
        raise ValueError(f"{text!r} is not a finite number")
    return number


def _text(text: str) -> str:
    if not text.strip():
        raise ValueError("is empty")
    return text


def _one_of(allowed: tuple[str, ...]) -> Callable[[str], str]:
    def check(text: str) -> str:
        """The unchanged cell, if allowed."""
        if text not in allowed:
            raise ValueError(f"{text!r} is not one of {', '.join(allowed)}")
        return text

    return check


def _type_index(text: str) -> int:
    if not 1 <= _whole(text) <= len(GRASP_TYPES):
        raise ValueError(f"{text} is not an index from 1 to {len(GRASP_TYPES)}")
    return int(text)


def parse_configuration(text: str) -> NDArray[np.float64] | None:
    """The 17 numbers (17,) of a HandConfiguration cell, metres and radians; None if it is blank.

    Raises:
        ValueError: not 17 finite numbers, the first not an integer, or a pose that is not rigid.
    """
    if not text.strip():
        return None
    numbers = np.array([_number(cell) for cell in text.split(",")])
    if len(numbers) != CONFIGURATION_LENGTH:
        raise ValueError(f"has {len(numbers)} numbers instead of {CONFIGURATION_LENGTH}")
    if numbers[0] < 0 or numbers[0] % 1:
        raise ValueError(f"its rank index {numbers[0]} is not a non-negative integer")
    hand = configuration.unpack(numbers)
    rotation = hand.T_object_hand[:3, :3]
    error = np.abs(rotation @ rotation.T - np.eye(3)).max()
    if error > RIGID_TOLERANCE or np.linalg.det(rotation) < 0:
        raise ValueError("its 3x4 pose has no valid rotation (orthonormal, right-handed)")
    if np.abs(hand.T_object_hand[:3, 3]).max() > FARTHEST_PALM_M:
        raise ValueError(f"its palm is more than {FARTHEST_PALM_M:g} m away: give metres")
    if np.abs(hand.dofs).max() > LARGEST_ANGLE_RAD:
        raise ValueError("its joints turn by more than 2 pi: give radians")
    return numbers


# Published column, our column, and how a cell is read. Type 7 is Invalid; if index and name of a
# row disagree, the name is correct (one Invalid row has index 4).
COLUMNS: tuple[tuple[str, str, Callable[[str], object]], ...] = (
    ("Index", "index", _whole),
    ("Object", "object", _text),
    ("Intent", "task", _one_of(TASKS)),
    ("Session", "session", _count),
    ("GraspType", "grasp_type", _one_of(GRASP_TYPES)),
    ("GraspTypeIndex", "grasp_type_index", _type_index),
    ("Rank", "rank", _count),
    ("Error", "energy", _number),
    ("PoseIndex", "pose_index", _whole),
    ("HandConfiguration", "hand_configuration", parse_configuration),
    ("Image", "image", str),
)


def read_published(path: str | Path) -> pd.DataFrame:
    """Read GraspTypesWithTasks.csv and check every cell.

    Returns:
        One row per grasp in the order of the file, with the columns index, object, task, session,
        grasp_type, grasp_type_index, rank, energy, pose_index, hand_configuration and image.
        A hand_configuration is an array (17,), see `hands.configuration`, or None if the cell
        is blank. Its DOFs are those of GraspIt!'s model of the hand, and may exceed the real
        hand's limits.

    Raises:
        InputError: names the file, and the first bad line and column.
    """
    path = Path(path)
    cells = read_cells(path)
    missing = [name for name, _, _ in COLUMNS if name not in cells.columns]
    if missing:
        raise InputError(path, missing[0], "this column is missing")
    if cells.empty:
        raise InputError(path, "", "has a header but no grasps")
    table = pd.DataFrame(
        {ours: _read_column(path, cells[theirs], read) for theirs, ours, read in COLUMNS}
    )
    repeated = table.duplicated(["object", "task", "session"])
    if repeated.any():
        row = int(repeated.to_numpy().argmax())
        key = f"line {row + 2}"
        raise InputError(path, key, "this object, task and session appear twice")
    return table


def read_cells(path: Path) -> pd.DataFrame:
    """All cells as text; a byte order mark is dropped."""
    try:
        text = path.read_text(encoding="utf-8-sig")
        header = next(csv.reader(text.splitlines()[:1]), [])
        twice = [name for name in header if header.count(name) > 1]
        if twice:
            raise InputError(path, twice[0], "this column appears twice")
        return pd.read_csv(io.StringIO(text), dtype=str, keep_default_na=False)
    except (FileNotFoundError, IsADirectoryError) as error:
        raise InputError(path, "", "no such file") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "", f"not UTF-8 text: {error}") from error
    except (pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise InputError(path, "", f"not a CSV table: {error}") from error


def _read_column(path: Path, cells: pd.Series, read: Callable[[str], object]) -> pd.Series:
    values = []
    for row, cell in enumerate(cells):
        try:
            values.append(read(cell))
        except ValueError as error:
            raise InputError(path, f"line {row + 2}, {cells.name}", str(error)) from error
    return pd.Series(values, dtype=object if read is parse_configuration else None)
