"""The tables of grasps (one row per session) and of attempts (one row per grasp tried).

Attempts with `moved_m` above 0 were tested in physics; the others were rejected by geometry alone.
"""

from __future__ import annotations

import pandas as pd
import pandera.pandas as pa

from grasptypes.hands.configuration import POSE_LENGTH
from grasptypes.synthesis.search import ALL_TERMS

# Why a grasp is invalid, in the order of the checks; empty if it is valid.
REASONS = ("joint_limit", "self_collision", "penetrates", "no_contact", "dropped")
# A pose's three rows of four.
POSE_NUMBERS = 12
ENERGY_TERMS = tuple(f"energy_{term}" for term in ALL_TERMS)


def _longer(column: pd.Series, length: int) -> pd.Series:
    """Whether lists have more numbers than `length`, and all as many as the first one."""
    lengths = column.map(len)
    return (lengths > length) & (lengths == lengths.iloc[0] if len(lengths) else True)


_POSE = pa.Check(lambda column: column.map(len) == POSE_NUMBERS)
_TRIAL_COLUMNS = {
    "object": pa.Column(str),
    "task": pa.Column(str),
    "session": pa.Column(int, pa.Check.ge(1), description="person, from 1"),
    "rank": pa.Column(int, pa.Check.ge(0), description="order of tries, from 0: by energy"),
    "energy": pa.Column(float, description="before physics; low is good"),
    **{term: pa.Column(float, description="part of the energy") for term in ENERGY_TERMS},
    "hand_configuration": pa.Column(
        object,
        pa.Check(lambda column: _longer(column, POSE_LENGTH)),
        description="see hands.configuration; held in physics, or planned if not",
    ),
    "joint_angles_rad": pa.Column(
        object,
        pa.Check(lambda column: _longer(column, 0)),
        description="in the order of the hand's joints; prismatic ones m",
    ),
    "stopped_joints": pa.Column(object, description="of each finger as held, from the palm"),
    "touching_pose": pa.Column(
        object, _POSE, description="3x4 of the hand as planned, row by row; it closes from there"
    ),
    "touching_joints": pa.Column(object, description="joint positions there"),
    "pregrasp_pose": pa.Column(object, _POSE, description="3x4 of the open hand before"),
    "pregrasp_joints": pa.Column(object, description="joint positions there"),
    "penetration_m": pa.Column(float, pa.Check.ge(0), description="hand and object in each other"),
    "moved_m": pa.Column(float, pa.Check.ge(0), description="object in the hand, once touched"),
    "turned_rad": pa.Column(float, pa.Check.ge(0), description="object in the hand"),
    "grip_deviation": pa.Column(
        float, pa.Check.ge(0), description="of that hand's shape from the person's grip"
    ),
    "bears_load": pa.Column(bool, description="holds under the task's load, too"),
    "valid": pa.Column(bool),
    "valid_strict": pa.Column(bool, description="valid, and within the strict depth"),
    "reason": pa.Column(str, pa.Check.isin(("", *REASONS))),
    "seed": pa.Column(int, pa.Check.ge(0), description="of the session's random draws"),
}
_REASON_MATCHES = pa.Check(lambda table: table.valid == (table.reason == ""), name="reason")

ATTEMPT_SCHEMA = pa.DataFrameSchema(
    {**_TRIAL_COLUMNS, "chosen": pa.Column(bool, description="is the session's grasp")},
    checks=_REASON_MATCHES,
    strict=True,
    ordered=True,
    unique=["object", "task", "session", "rank"],
)
GRASP_SCHEMA = pa.DataFrameSchema(
    {
        **_TRIAL_COLUMNS,
        "tries": pa.Column(int, pa.Check.ge(1), description="grasps that were looked at"),
        "grip": pa.Column(str, description="the person's"),
        "contact_links": pa.Column(object, description="link of each contact, its name"),
        "contact_points_m": pa.Column(object, description="3 numbers a contact, object frame"),
        "contact_normals": pa.Column(object, description="3 a contact, into the object"),
        "contact_forces_n": pa.Column(object, description="of each contact, along its normal"),
    },
    checks=_REASON_MATCHES,
    strict=True,
    ordered=True,
    unique=["object", "task", "session"],
)
