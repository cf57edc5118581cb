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
from grasptypes.hand.kinematics import JOINT_NAMES

GRIPPER = "Barrett"
FRAME = "GraspIt! Barrett palm, metres"


def write_grasps(path: str | Path, hands: PosedHands) -> None:
    """Write all grasps of an object."""
    content = {
        "gripper": GRIPPER,
        "object_id": hands.object_name,
        "pose": to_position_quaternion(hands.T_object_hand).tolist(),
        "dofs": hands.joint_angles_rad.tolist(),
        "result": hands.held.astype(int).tolist(),
        "joint_names": list(JOINT_NAMES),
        "frame": FRAME,
    }
    write_json(path, content)


def read_grasps(path: str | Path) -> PosedHands:
    """Read grasps with eight joint values in our order, or in the order of `joint_names`.

    Raises:
        InputError: the file is not in this format.
    """
    content = _read(path)
    names = list(content.get("joint_names", JOINT_NAMES))
    if sorted(names) != sorted(JOINT_NAMES):
        raise InputError(path, "joint_names", f"must be {', '.join(JOINT_NAMES)} in any order")
    try:
        poses = from_position_quaternion(content["pose"])
        dofs = np.asarray(content["dofs"], dtype=np.float64).reshape(len(poses), len(names))
    except (ValueError, TypeError) as error:
        raise InputError(
            path, "pose, dofs", f"7 and 8 numbers per grasp are needed: {error}"
        ) from error
    angles = dofs[:, [names.index(name) for name in JOINT_NAMES]]
    held = np.asarray(content.get("result", np.ones(len(poses))), dtype=float) > 0.5
    return PosedHands(str(content["object_id"]), poses, angles, held)


def _read(path: str | Path) -> dict[str, Any]:
    try:
        content: dict[str, Any] = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(path, "", f"is not a JSON file: {error}") from error
    missing = {"gripper", "object_id", "pose", "dofs"} - set(content)
    if missing:
        raise InputError(path, ", ".join(sorted(missing)), "is missing")
    if "barrett" not in str(content["gripper"]).lower():
        raise InputError(path, "gripper", f"{content['gripper']!r} is not the BarrettHand")
    return content
