"""Study: do parts that were found in an object's shape help to plan grasps as people would?

A scan whose true roles are known is planned twice, with all grips and equally many sessions: where
people hold the parts that its shape shows, and anywhere. A rule over the true roles then judges the
valid grasps, and once more those of them that a plan with parts puts first.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.hands.reading import load_hand
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.planning.demands import HANDLES, hold_as_demanded
from grasptypes.planning.plan_comparison import tests
from grasptypes.planning.plan_contacts import grips_of, plan_contacts
from grasptypes.planning.sessions import PlanningContext, plan_sessions
from grasptypes.planning.touching import touching
from grasptypes.segmentation.known_parts import known_parts
from grasptypes.segmentation.true_roles import TrueRoles
from grasptypes.settings.commands import PlanSettings
from grasptypes.settings.holds import TouchSettings
from grasptypes.settings.roles import PartRole
from grasptypes.settings.tasks import Task, read_tasks

# With the parts that were found; of these plans only the grasps that keep off parts to avoid, which
# come first; without parts.
FOUND, FIRST, ANYWHERE = WAYS = ("found", "first", "none")
COUNT = pa.Check.ge(0)
PART_PLAN_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        "parts": pa.Column(str, pa.Check.isin(WAYS)),
        "sessions": pa.Column(int, pa.Check.ge(1)),
        "tests": pa.Column(int, COUNT, description="hands that physics saw"),
        "valid": pa.Column(int, COUNT, description="sessions with a valid grasp"),
        "held": pa.Column(
            int, COUNT, description="valid, and most of the contact is on parts that people touch"
        ),
        "clear": pa.Column(
            int, COUNT, description="valid, without contact on what is hazardous or must stay free"
        ),
        "handle_free": pa.Column(
            int, COUNT, description="valid, and most of the contact leaves handles free"
        ),
        "safe": pa.Column(int, COUNT, description="valid, without contact on hazardous parts"),
        "offered": pa.Column(int, COUNT, description="handle_free and safe"),
        "accepted": pa.Column(int, COUNT, description="held and clear"),
    },
    strict=True,
    ordered=True,
    unique=["object", "task", "parts"],
)
SHARE = pa.Check.in_range(0, 1)
VERDICTS = ("held", "clear", "handle_free", "safe", "offered", "accepted")
# The sets of scans, and how the names of the objects of one of them begin.
CONTACTDB, YCB = SETS = ("contactdb", "ycb")
GAIN_SCHEMA = pa.DataFrameSchema(
    {
        "scans": pa.Column(str, pa.Check.isin(SETS)),
        "task": pa.Column(str),
        "parts": pa.Column(str, pa.Check.isin(WAYS)),
        "held": pa.Column(float, SHARE, description="share of the valid grasps"),
        "clear": pa.Column(float, SHARE),
        "handle_free": pa.Column(float, SHARE),
        "safe": pa.Column(float, SHARE),
        "offered": pa.Column(float, SHARE),
        "accepted": pa.Column(float, SHARE),
        "valid": pa.Column(float, SHARE, description="share of the sessions"),
        "tests_per_accepted": pa.Column(float, nullable=True),
        "gain": pa.Column(float, description="of the accepted share, mean over objects"),
        "error": pa.Column(
            float, nullable=True, description="standard error of the gain over objects"
        ),
    },
    strict=True,
    ordered=True,
)


def study_plans(
    context: PlanningContext, true: TrueRoles, touch: TouchSettings
) -> list[dict[str, Any]]:
    """The rows of a scan and a task, with and without parts; see `PART_PLAN_SCHEMA`."""
    params, grips = context.params, grips_of(GRASP_TYPES[:-1])
    settings = params.contact_maps.changed(sessions=params.plan.parts.sessions)
    drawn = MapTask.of_object(context.geometry, (context.word, context.task), params.seed, settings)
    task = read_tasks()[context.task]
    parts = known_parts(context.geometry, drawn.points, params.segmentation)
    anywhere = plan_contacts(drawn, None, grips, context.geometry.source)
    found = hold_as_demanded(drawn, context.geometry, parts, grips, params) or anywhere
    types, rows = GRASP_TYPES[:-1], []
    for name, contacts in ((FOUND, found), (ANYWHERE, anywhere)):
        attempts, grasps = plan_sessions(context, contacts, types)
        judged = {name: grasps}
        if name == FOUND:
            judged[FIRST] = grasps[~grasps.touches_avoided]
        for way, some in judged.items():
            rows.append(
                {
                    "object": context.geometry.name,
                    "task": context.task,
                    "parts": way,
                    "sessions": params.plan.parts.sessions,
                    "tests": tests(attempts),
                    **_judged(context, some, true, touch, task),
                }
            )
    return rows


def _judged(
    context: PlanningContext,
    grasps: pd.DataFrame,
    true: TrueRoles,
    touch: TouchSettings,
    task: Task,
) -> dict[str, int]:
    """How many of some grasps are valid, and how many the rule accepts."""
    hand, grid = load_hand(context.hand), context.geometry.distance_grid
    verdicts = [
        accepts(
            contact_shares(true.at(*touching(hand, grid, numbers, touch))),
            task,
            context.params.plan,
        )
        for numbers in grasps[grasps.valid].hand_configuration
    ]
    held, clear, free, safe = np.array(verdicts, dtype=bool).reshape(-1, 4).T
    return {
        "valid": len(verdicts),
        "held": int(held.sum()),
        "clear": int(clear.sum()),
        "handle_free": int(free.sum()),
        "safe": int(safe.sum()),
        "offered": int((free & safe).sum()),
        "accepted": int((held & clear).sum()),
    }


def contact_shares(touched: Sequence[PartRole]) -> list[tuple[PartRole, float]]:
    """Each of the roles that points of a hand touch, with its share of these points."""
    of_role = {part.role: part for part in touched}
    count = Counter(part.role for part in touched)
    return [(part, count[role] / len(touched)) for role, part in of_role.items()]


def accepts(
    shares: Sequence[tuple[PartRole, float]], task: Task, settings: PlanSettings
) -> tuple[bool, bool, bool, bool]:
    """Whether a grasp with these shares of contact is where people hold an object for a task.

    Returns:
        whether most of the contact is on roles that people touch; whether nothing is on roles that
        must stay free, nor on hazardous parts that people do not touch; whether handles are left
        free; whether nothing is on hazardous parts.
    """
    held = sum(share for part, share in shares if task.touched.get(part.role, 0.0) > 0)
    wrong = sum(
        share
        for part, share in shares
        if part.role in task.free or (part.hazardous and part.role not in task.touched)
    )
    on_handle = sum(share for part, share in shares if part.role in HANDLES)
    on_hazard = sum(share for part, share in shares if part.hazardous)
    off = wrong <= settings.trace, on_handle <= settings.parts.covered, on_hazard <= settings.trace
    return held > 1 / 2, *off


def summary(table: pd.DataFrame) -> pd.DataFrame:
    """One row per set of scans, task and `parts`: shares, cost of an accepted grasp, and gain.

    The gain is that of the share of valid grasps that are accepted, with its standard error over
    objects.
    """
    rows = []
    sets = np.where(table.object.str.startswith(f"{YCB}_"), YCB, CONTACTDB)
    for (scans, task), of_task in table.groupby([sets, "task"], sort=False):
        share = of_task.assign(share=of_task.accepted / of_task.valid.clip(lower=1)).pivot(
            index="object", columns="parts", values="share"
        )
        for parts, some in of_task.groupby("parts", sort=False):
            gain = share[parts] - share[ANYWHERE]
            total = some[["sessions", "tests", "valid", *VERDICTS]].sum()
            rows.append(
                {
                    "scans": scans,
                    "task": task,
                    "parts": parts,
                    **{name: total[name] / max(total.valid, 1) for name in VERDICTS},
                    "valid": total.valid / total.sessions,
                    "tests_per_accepted": total.tests / total.accepted
                    if total.accepted
                    else np.nan,
                    "gain": gain.mean(),
                    "error": gain.std() / np.sqrt(len(gain)),
                }
            )
    return pd.DataFrame(rows).round(3)
