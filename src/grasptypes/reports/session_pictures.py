"""Images of all grasps of an object, with their types or reasons for rejection."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import PurePath

import pandas as pd

from grasptypes.labels.dataset import VALID
from grasptypes.renders.archives import Picture
from grasptypes.reports.sheets import INK, WARNING, Group, Tile


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
