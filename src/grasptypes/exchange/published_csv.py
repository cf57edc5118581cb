"""The published CSV: our grasps in the authors' columns; `read_published` reads them back."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike
from scipy.spatial.transform import RigidTransform

from grasptypes.exchange.records import PosedHands
from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand


def authors_columns(table: pd.DataFrame, types: Sequence[str]) -> pd.DataFrame:
    """The authors' eleven columns.

    Args:
        table: columns object, task, session, grasp_type, rank (from 0), energy, pose_index,
            hand_configuration (13 + D numbers each) and image.
        types: all grasp types, in the order of their indices.
    """
    return pd.DataFrame(
        {
            "Index": np.arange(len(table)),
            "Object": table.object.to_numpy(),
            "Intent": table.task.to_numpy(),
            "Session": table.session.to_numpy(),
            "GraspType": table.grasp_type.to_numpy(),
            "GraspTypeIndex": [types.index(name) + 1 for name in table.grasp_type],
            "Rank": table["rank"].to_numpy() + 1,
            "Error": table.energy.to_numpy(),
            "PoseIndex": table.pose_index.to_numpy(),
            "HandConfiguration": [format_configuration(row) for row in table.hand_configuration],
            "Image": table.image.to_numpy(),
        }
    )


def format_configuration(numbers: ArrayLike) -> str:
    """A hand configuration as a cell: an integer rank index, the rest with nine digits."""
    rank_index, *others = np.asarray(numbers, dtype=np.float64)
    return ",".join([str(int(rank_index)), *(f"{value:.9g}" for value in others)])


def posed_hands(published: pd.DataFrame, object_name: str, hand: Hand) -> PosedHands:
    """The hands of one object in a table of `published.read_published`, fingertips coupled."""
    known = published.hand_configuration.notna() & (published.object == object_name)
    rows = published[known]
    posed = configuration.unpack(np.stack(rows.hand_configuration.tolist()))
    held = (rows.grasp_type != "Invalid").to_numpy(dtype=bool)
    poses = RigidTransform(posed.T_object_hand, normalize=False)
    return PosedHands(object_name, hand, poses, hand.couple(posed.dofs), held)
