"""Images of all grasps of an object, with their types or reasons for rejection."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePath

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from PIL import Image

from grasptypes.labels.dataset import VALID
from grasptypes.reports.sheets import INK, WARNING, Group, Tile

Picture = NDArray[np.uint8]


def read_named_pictures(path: str | Path) -> dict[str, Picture]:
    """The images (H, W, 3) of a data/screenshots archive by file name."""
    with zipfile.ZipFile(path) as archive:
        return {
            name: np.asarray(Image.open(io.BytesIO(archive.read(name))).convert("RGB"))
            for name in archive.namelist()
        }


def session_groups(
    rows: pd.DataFrame, pictures: Mapping[str, Picture], tasks: Sequence[str]
) -> list[Group]:
    """One group per task, with the images in the order of the sessions.

    Args:
        rows: of `dataset.dataset_schema`, of one object.
        pictures: of `read_named_pictures`.
    """
    return [_group(rows[rows.Intent == task], pictures, task) for task in tasks]


def _group(rows: pd.DataFrame, pictures: Mapping[str, Picture], task: str) -> Group:
    ordered = rows.sort_values("Session")
    tiles = [
        Tile(
            pictures[PurePath(row.Image).name],
            f"{row.Session} {row.GraspType if row.reason == VALID else row.reason}",
            INK if row.reason == VALID else WARNING,
        )
        for row in ordered.itertuples()
    ]
    valid = int((rows.reason == VALID).sum())
    return Group(f"{ordered.Object.iloc[0]}, {task}: {valid} of {len(rows)} valid", tiles)
