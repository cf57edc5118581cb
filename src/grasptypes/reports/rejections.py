"""Examples of rejected grasps for every reason, as in Figure 3 of the paper."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from grasptypes.synthesis.grasps import REASONS

IN_WORDS = {
    "joint_limit": "a joint beyond its limits",
    "self_collision": "one link of the hand in another",
    "penetrates": "the hand in the object",
    "no_contact": "too few contacts",
    "dropped": "dropped under gravity",
}


def examples(attempts: pd.DataFrame, number: int) -> pd.DataFrame:
    """For each reason, the rejected attempts of lowest energy, from different objects if possible.

    Args:
        attempts: of `grasps.ATTEMPT_SCHEMA`, of all objects.
        number: maximum number of examples per reason.

    Returns:
        rows of `attempts`, in the order of `REASONS` and of energy.
    """
    rejected = attempts[~attempts.valid].sort_values(
        ["energy", "object", "task", "session", "rank"], kind="stable"
    )
    turn = rejected.groupby(["reason", "object"]).cumcount()
    ordered = rejected.assign(turn=turn).sort_values("turn", kind="stable")
    chosen = ordered.groupby("reason", sort=False).head(number)
    place = chosen.reason.map(REASONS.index)
    chosen = chosen.assign(place=place).sort_values(["place", "turn", "energy"], kind="stable")
    return chosen.drop(columns=["turn", "place"])


def heading(attempts: pd.DataFrame, reason: str) -> str:
    """A reason in words, and the number of attempts rejected for it."""
    rows = attempts[attempts.reason == reason]
    return f"{IN_WORDS[reason]} ({reason}): {len(rows)} of {len(attempts)} attempts"


def caption(row: Any) -> str:
    """Object, task, and the measured value or the reason of an attempt."""
    turned_deg = np.rad2deg(row.turned_rad)
    measured = {
        "penetrates": f"{row.penetration_m * 1e3:.1f} mm deep",
        "dropped": f"moved {row.moved_m * 1e3:.0f} mm, {turned_deg:.0f}°",
    }
    return f"{row.object}, {row.task}: {measured.get(row.reason, row.reason)}"
