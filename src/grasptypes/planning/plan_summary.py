"""A plan in few words: as plain values for programs, as lines for people."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from grasptypes.labels.dataset import VALID
from grasptypes.objects.object_files import Properties
from grasptypes.planning.planner import Planned


def summarise(
    planned: Planned,
    types: Sequence[str],
    chosen_by: Mapping[str, Any] | None,
    contact_map: str | None,
    properties: Properties,
) -> dict[str, Any]:
    """Everything there is to say.

    Args:
        types: the wanted grasp types.
        chosen_by: the predictor that chose them, with its answer; None if they were given.
        contact_map: name of the measured map, if there was one.
        properties: of the object.
    """
    grasps = planned.grasps
    wanted = grasps.grasp_type.isin(types)
    return {
        "object": properties.object,
        "task": str(grasps.task.iloc[0]),
        "mass_kg": properties.mass_kg,
        "repairs": properties.repairs,
        "wanted_types": list(types),
        "chosen_by": chosen_by,
        "contact_map": contact_map,
        "sessions": len(grasps),
        "tries": len(planned.attempts),
        "valid": int(grasps.valid.sum()),
        "valid_of_wanted_type": int((grasps.valid & wanted).sum()),
        "grasps": [
            {
                "rank": int(row.rank) + 1,
                "session": int(row.session),
                "grasp_type": row.grasp_type,
                "wanted": row.grasp_type in types,
                "reason": VALID if row.valid else row.reason,
                "branch": row.branch,
                "margin": float(row.margin),
                "energy": float(row.energy),
                "tries": int(row.tries),
                "penetration_m": float(row.penetration_m),
                "hand_configuration": [float(number) for number in row.hand_configuration],
                "joint_angles_rad": [float(angle) for angle in row.joint_angles_rad],
            }
            for row in grasps.itertuples()
        ],
    }


def report(summary: Mapping[str, Any]) -> str:
    """The same for people: a row a grasp."""
    by = summary["chosen_by"]
    chosen = f"chosen by {by['model']}, {by['labels']} labels" if by else "as asked"
    types, held = ", ".join(summary["wanted_types"]), summary["valid_of_wanted_type"]
    lines = [
        f"{summary['object']} for {summary['task']}: {types} ({chosen})",
        f"{summary['valid']} of {summary['sessions']} grasps hold, {held} of a wanted type; "
        f"{summary['tries']} tries",
        "",
        f"rank  {'grasp type':18}{'energy':>8}  session  tries  reason",
    ]
    for grasp in summary["grasps"]:
        star = "*" if grasp["wanted"] else ""
        kind = f"{grasp['grasp_type']}{star}"
        lines.append(
            f"{grasp['rank']:4}  {kind:18}{grasp['energy']:8.3f}  {grasp['session']:7}  "
            f"{grasp['tries']:5}  {grasp['reason']}"
        )
    return "\n".join([*lines, "", "* of a wanted type"]) + "\n"
