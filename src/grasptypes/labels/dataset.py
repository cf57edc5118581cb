"""The dataset: every grasp with its label and explanation, and the samples counted from it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.exchange.published_csv import authors_columns
from grasptypes.hands import configuration
from grasptypes.hands.configuration import POSE_LENGTH
from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.labels.contacts import DistanceField
from grasptypes.labels.grasp_type import (
    GRASP_TYPES,
    INVALID,
    TYPES,
    explain,
    measure,
    thresholds_of,
)
from grasptypes.labels.recorded import joint_columns, state_cells
from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.settings.grasp_types import LabellingRule

VALID = "valid"
_MEASURES = {
    "palm_gap_m": "palm_gap_m",
    "enclosed_diameter_m": "diameter_m",
    "sideways_share": "sideways_share",
    "span_m": "span_m",
}


def dataset_schema(hand: Hand) -> pa.DataFrameSchema:
    """Schema of the dataset of a hand's grasps."""
    commas = POSE_LENGTH + len(hand.dof_names) - 1
    limits = zip(joint_columns(hand), hand.joint_limits, strict=True)
    return pa.DataFrameSchema(
        {
            "Index": pa.Column(int, pa.Check.ge(0), unique=True),
            "Object": pa.Column(str),
            "Intent": pa.Column(str),
            "Session": pa.Column(int, pa.Check.ge(1)),
            "GraspType": pa.Column(str, pa.Check.isin(GRASP_TYPES)),
            "GraspTypeIndex": pa.Column(int, pa.Check.in_range(1, len(GRASP_TYPES))),
            "Rank": pa.Column(int, pa.Check.ge(1)),
            "Error": pa.Column(float),
            "PoseIndex": pa.Column(int, pa.Check.ge(0)),
            "HandConfiguration": pa.Column(
                str, pa.Check(lambda cells: cells.str.count(",") == commas)
            ),
            "Image": pa.Column(str),
            "hand": pa.Column(str, pa.Check.eq(hand.title)),
            "reason": pa.Column(str, description="'valid', or why the grasp is invalid"),
            "shape": pa.Column(str, pa.Check.isin(TYPES), description="type by the rule"),
            "branch": pa.Column(str, description="the way through the tree"),
            "margin": pa.Column(float, pa.Check.ge(0), description="to the nearest threshold"),
            "virtual_fingers": pa.Column(int, pa.Check.isin([2, 3])),
            **{name: pa.Column(float) for name in _MEASURES.values()},
            "penetration_m": pa.Column(float, pa.Check.ge(0)),
            "bears_load": pa.Column(bool, description="holds under the task's load, too"),
            "tries": pa.Column(int, pa.Check.ge(1)),
            **{
                name: pa.Column(float, pa.Check.in_range(low - 1e-6, high + 1e-6))
                for name, (low, high) in limits
            },
            "stopped_joints": pa.Column(str, description="of each finger, as held"),
            "touching_pose": pa.Column(str, description="3x4 of the hand that closes next"),
            "touching_joints": pa.Column(str, description="all joints there, all digits"),
            "pregrasp_pose": pa.Column(str, description="3x4 of the open hand before"),
            "pregrasp_joints": pa.Column(str, description="all joints there"),
        },
        strict=True,
        ordered=True,
        unique=["Object", "Intent", "Session"],
    )


def label_grasps(
    grasps: pd.DataFrame, hand: Hand, field: DistanceField, rule: LabellingRule
) -> pd.DataFrame:
    """Label the grasps of one object.

    Args:
        grasps: of `grasps.GRASP_SCHEMA`, one object.
        hand: the hand of the grasps.
        field: distance to the object.

    Returns:
        `grasps` with the columns grasp_type (Invalid unless valid), shape (the type regardless of
        physics), branch, margin, virtual_fingers and the measures.
    """
    poses = configuration.unpack(np.stack(grasps.hand_configuration.tolist())).T_object_hand
    positions = np.stack(grasps.joint_angles_rad.tolist()).astype(np.float64)
    measures = measure(field, HandStates(hand, poses, positions), rule.contacts)
    labels = pd.DataFrame(explain(measures, thresholds_of(rule, hand)), index=grasps.index)
    labels = labels.rename(columns={"grasp_type": "shape"})
    labels.insert(0, "grasp_type", labels["shape"].where(grasps.valid, INVALID))
    for name, column in _MEASURES.items():
        labels[column] = getattr(measures, name)
    return pd.concat([grasps, labels], axis=1)


def dataset_table(labelled: Sequence[pd.DataFrame], hand: Hand) -> pd.DataFrame:
    """All labelled grasps in the authors' columns and ours: a table of `dataset_schema`.

    Sorted by object, task and session. `PoseIndex` is the position of the grasp among those tried
    in its session, and `Image` the path of the screenshot below data/.
    """
    table = pd.concat(labelled, ignore_index=True)
    table = table.sort_values(["object", "task", "session"], ignore_index=True)
    table["pose_index"] = table["rank"]
    keys = table[["object", "session", "task"]].itertuples(index=False)
    table["image"] = [image_name(*key) for key in keys]
    return dataset_columns(table, hand)


def dataset_columns(table: pd.DataFrame, hand: Hand) -> pd.DataFrame:
    """Labelled grasps in the authors' columns and ours, in the given order.

    Args:
        table: of `label_grasps`, with the columns pose_index and image.
    """
    positions = np.stack(table.joint_angles_rad.tolist()).astype(np.float64)
    ours = pd.DataFrame(
        {
            "hand": hand.title,
            "reason": table.reason.where(~table.valid, VALID),
            **{name: table[name] for name in ("shape", "branch", "margin", "virtual_fingers")},
            **{name: table[name] for name in _MEASURES.values()},
            "penetration_m": table.penetration_m,
            "bears_load": table.bears_load,
            "tries": table.tries,
            **dict(zip(joint_columns(hand), positions.T, strict=True)),
        }
    )
    states = pd.DataFrame(state_cells(table))
    return pd.concat([authors_columns(table, GRASP_TYPES), ours.round(9), states], axis=1)


def image_name(object_name: str, session: int, task: str) -> str:
    """Path of a grasp's screenshot, named like the authors'."""
    return f"screenshots/{object_name}_{session}_{task}.png"


def sample_table(
    dataset: pd.DataFrame, file: str | Path = "data/grasps.csv", least: int = 0
) -> pd.DataFrame:
    """Count the valid grasps of each (object, task): a table of `samples.SAMPLE_SCHEMA`.

    Args:
        file: file name for errors.
        least: pairs with fewer valid grasps are left out; 0 leaves none out.

    Raises:
        InputError: an (object, task) without a valid grasp, if none is left out.
    """
    columns = dict(zip(TYPES, COUNTS, strict=True))
    counted = pd.crosstab([dataset.Object, dataset.Intent], dataset.GraspType.map(columns))
    counts = counted.reindex(columns=list(COUNTS), fill_value=0).reset_index()
    everything = dataset[["Object", "Intent"]].drop_duplicates()
    counts = everything.merge(counts, how="left").fillna(0)
    counts = counts[counts[list(COUNTS)].sum(axis=1) >= least]
    counts = counts.rename(columns={"Object": "object", "Intent": "task"})
    return samples_from_counts(counts.astype(dict.fromkeys(COUNTS, int)), file)
