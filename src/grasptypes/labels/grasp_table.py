"""Grasps of any hand in a CSV: ours, a plan's, or a table with the published columns."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.hands import configuration
from grasptypes.hands.configuration import POSE_LENGTH
from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.labels.published import RIGID_TOLERANCE, read_cells
from grasptypes.labels.recorded import joint_columns

Array = NDArray[np.float64]

CONFIGURATION = "HandConfiguration"


def read_grasp_table(path: str | Path, hand: Hand) -> tuple[pd.DataFrame, HandStates]:
    """Read the grasps of a CSV.

    Args:
        path: has the column HandConfiguration, see `hands.configuration`. Without one column per
            joint (`proximal_1_rad`), fingers are taken to have closed without a stop.
        hand: the hand of the grasps.

    Returns:
        all cells as text, indexed by the row of the file, and the hands in the object's frame; both
        without the rows whose HandConfiguration is blank.

    Raises:
        InputError: names the file, and the first bad line and column.
    """
    path = Path(path)
    cells = read_cells(path)
    if CONFIGURATION not in cells.columns:
        raise InputError(path, CONFIGURATION, "this column is missing")
    cells = cells[cells[CONFIGURATION].str.strip() != ""]
    if cells.empty:
        raise InputError(path, "", "has no grasps")
    numbers = np.stack(
        [_configuration(path, line, text, hand) for line, text in _lines(cells[CONFIGURATION])]
    )
    posed = configuration.unpack(numbers)
    names = joint_columns(hand)
    known = [name for name in names if name in cells.columns]
    if known and known != names:
        missing = next(name for name in names if name not in known)
        raise InputError(path, missing, f"this column is missing; {known[0]} is there")
    positions = hand.couple(posed.dofs)
    if known:
        positions = np.stack([number_column(path, cells[name]) for name in names], axis=1)
    return cells, HandStates(hand, posed.T_object_hand, positions)


def _lines(column: pd.Series) -> list[tuple[int, str]]:
    """Cells with the line of the file that they are in; the first line is the header."""
    return [(int(row) + 2, text) for row, text in column.items()]


def number_column(path: Path, column: pd.Series) -> Array:
    """The numbers (n,) of a column of cells from `path`.

    Raises:
        InputError: names the line of the first cell that is not one finite number.
    """
    return np.array(
        [_numbers(path, line, str(column.name), cell)[0] for line, cell in _lines(column)]
    )


def _numbers(path: Path, line: int, name: str, text: str) -> Array:
    """Comma-separated finite numbers."""
    try:
        numbers = np.array(text.split(","), dtype=np.float64)
    except ValueError as error:
        raise InputError(path, f"line {line}, {name}", f"not a number in {text!r}") from error
    if not np.isfinite(numbers).all():
        raise InputError(path, f"line {line}, {name}", f"not a finite number in {text!r}")
    return numbers


def _configuration(path: Path, line: int, text: str, hand: Hand) -> Array:
    """The numbers of a cell (13 + D,), with a rigid pose."""
    key, length = f"line {line}, {CONFIGURATION}", POSE_LENGTH + len(hand.dof_names)
    numbers = _numbers(path, line, CONFIGURATION, text)
    if len(numbers) != length:
        said = f"has {len(numbers)} numbers; {hand.title} needs {length} (another hand: --hand)"
        raise InputError(path, key, said)
    rotation = configuration.unpack(numbers).T_object_hand[:3, :3]
    if np.abs(rotation @ rotation.T - np.eye(3)).max() > RIGID_TOLERANCE:
        raise InputError(path, key, "its 3x4 pose has no valid rotation (orthonormal)")
    return numbers
