"""Summary of a plan: as plain values, and as text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from grasptypes.labels.dataset import VALID
from grasptypes.planning.planner import Plan


def summarise(plan: Plan) -> dict[str, Any]:
    """The complete summary as plain values for JSON."""
    grasps, types, properties = plan.ranking, plan.request.types, plan.geometry.properties
    wanted = grasps.grasp_type.isin(types)
    return {
        "object": properties.object,
        "task": plan.task,
        "hand": plan.hand.title,
        "mass_kg": properties.mass_kg,
        "repairs": properties.repairs,
        "wanted_types": list(types),
        "chosen_by": plan.request.chosen_by,
        "contact_map": plan.contact_map,
        "parts": plan.parts and plan.parts.summary(),
        "given_up": list(plan.given_up),
        "sessions": len(grasps),
        "tries": len(plan.attempts),
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
                "touches_avoided": bool(row.touches_avoided),
                "tries": int(row.tries),
                "penetration_m": float(row.penetration_m),
                "hand_configuration": [float(number) for number in row.hand_configuration],
                "joint_angles_rad": [float(angle) for angle in row.joint_angles_rad],
            }
            for row in grasps.itertuples()
        ],
    }


def report(summary: Mapping[str, Any]) -> str:
    """The summary as text, one row per grasp."""
    by = summary["chosen_by"]
    chosen = f"chosen by {by['model']}, {by['labels']} labels" if by else "as asked"
    types, held = ", ".join(summary["wanted_types"]), summary["valid_of_wanted_type"]
    lines = [
        f"{summary['object']} for {summary['task']}, {summary['hand']}: {types} ({chosen})",
        f"{summary['valid']} of {summary['sessions']} grasps are valid, "
        f"{held} of a requested type; {summary['tries']} tries",
        "",
        f"rank  {'grasp type':18}{'energy':>8}  session  tries  reason",
    ]
    for grasp in summary["grasps"]:
        star = "*" if grasp["wanted"] else ""
        kind = f"{grasp['grasp_type']}{star}"
        note = ", on parts to avoid" if grasp["touches_avoided"] else ""
        lines.append(
            f"{grasp['rank']:4}  {kind:18}{grasp['energy']:8.3f}  {grasp['session']:7}  "
            f"{grasp['tries']:5}  {grasp['reason']}{note}"
        )
    return "\n".join([*lines, "", "* requested type"]) + "\n"
