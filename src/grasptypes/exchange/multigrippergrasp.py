"""MultiGripperGrasp JSON: all grasps of one object by one gripper.

The format (isaac_sim_grasping, "Grasp Data Format" and manager.py): a dictionary with
`gripper`, `object_id`, `pose` (one per grasp: the gripper in the object's frame, position then
quaternion, w first as in Isaac Sim) and `dofs` (joint values); its simulation adds `result`,
1 for a grasp that passed. Its tools keep further keys, so ours name the joints and the frame.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from grasptypes.errors import InputError
from grasptypes.exchange.records import (
    PosedHands,
    from_position_quaternion,
    to_position_quaternion,
)
from grasptypes.files import write_json
from grasptypes.hands.hand import Hand


def write_grasps(path: str | Path, hands: PosedHands) -> None:
    """Write all grasps of an object."""
    content = {
        "gripper": hands.hand.exchange.gripper,
        "object_id": hands.object_name,
        "pose": to_position_quaternion(hands.T_object_hand).tolist(),
        "dofs": hands.joint_positions.tolist(),
        "result": hands.held.astype(int).tolist(),
        "joint_names": list(hands.hand.joint_names),
        "frame": hands.hand.exchange.frame,
    }
    write_json(path, content)


def read_grasps(path: str | Path, hand: Hand) -> PosedHands:
    """Read grasps of a hand with joint values in our order, or in the order of `joint_names`.

    Raises:
        InputError: the file is not in this format.
    """
    content = _read(path, hand)
    names = list(content.get("joint_names", hand.joint_names))
    if sorted(names) != sorted(hand.joint_names):
        message = f"must be {', '.join(hand.joint_names)} in any order"
        raise InputError(path, "joint_names", message)
    try:
        poses = from_position_quaternion(content["pose"])
        dofs = np.asarray(content["dofs"], dtype=np.float64).reshape(len(poses), len(names))
    except (ValueError, TypeError) as error:
        message = f"7 and {len(names)} numbers per grasp are needed: {error}"
        raise InputError(path, "pose, dofs", message) from error
    positions = dofs[:, [names.index(name) for name in hand.joint_names]]
    held = np.asarray(content.get("result", np.ones(len(poses))), dtype=float) > 0.5
    return PosedHands(str(content["object_id"]), hand, poses, positions, held)


def _read(path: str | Path, hand: Hand) -> dict[str, Any]:
    try:
        content: dict[str, Any] = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(path, "", f"is not a JSON file: {error}") from error
    missing = {"gripper", "object_id", "pose", "dofs"} - set(content)
    if missing:
        raise InputError(path, ", ".join(sorted(missing)), "is missing")
    if hand.exchange.gripper.lower() not in str(content["gripper"]).lower():
        raise InputError(path, "gripper", f"{content['gripper']!r} is not {hand.title}")
    return content
