"""DexGraspBench npy: one dictionary per grasp, pickled in a NumPy file.

The format (DexGraspBench, README and src/task/convert_format.py): `obj_pose` (7, position
then quaternion w, x, y, z, in the world), `obj_scale`, `obj_path`, and `pregrasp_qpos`,
`grasp_qpos`, `squeeze_qpos` (7 + joints: the hand's pose in the world, then its joint angles); its
converters open the hand to 0.9 of the angles before and close it to 1.1 after the grasp.

A pickle can run code when it is read, so files are read by an unpickler that accepts only NumPy
arrays and plain values.
"""

from __future__ import annotations

import io
import pickle
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import RigidTransform

from grasptypes.errors import InputError, parsing
from grasptypes.exchange.records import (
    PosedHands,
    from_position_quaternion,
    relative,
    to_position_quaternion,
)
from grasptypes.files import write_bytes
from grasptypes.hands.hand import Hand

POSE = 7
OPEN, CLOSED = 0.9, 1.1
_NUMPY = {"_reconstruct", "scalar", "ndarray", "dtype", "_frombuffer"}


class _ArrayUnpickler(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        """Allow only the classes that NumPy arrays are made of."""
        if module.split(".")[0] == "numpy" and name in _NUMPY:
            return super().find_class(module, name)
        raise pickle.UnpicklingError(f"holds {module}.{name}, which is not an array")


def write_grasp(
    path: str | Path, hands: PosedHands, index: int, scale: float, object_path: str
) -> None:
    """Write one grasp, with the object at the origin of the world.

    Args:
        scale: scale of the mesh in `object_path`.
        object_path: folder of the object as prepared by MeshProcess.
    """
    pose = to_position_quaternion(hands.T_object_hand[index])
    hand, positions = hands.hand, hands.joint_positions[index]
    content = {
        "obj_pose": to_position_quaternion(RigidTransform.identity()),
        "obj_scale": float(scale),
        "obj_path": object_path,
        "pregrasp_qpos": np.concatenate([pose, _turned(hand, positions, OPEN)]),
        "grasp_qpos": np.concatenate([pose, positions]),
        "squeeze_qpos": np.concatenate([pose, _turned(hand, positions, CLOSED)]),
    }
    buffer = io.BytesIO()
    np.save(buffer, np.array(content, dtype=object), allow_pickle=True)
    write_bytes(path, buffer.getvalue())


def read_grasp(path: str | Path, hand: Hand) -> PosedHands:
    """Read one grasp of a hand with its joints in our order.

    Raises:
        InputError: the file is not a grasp, or has content other than arrays and plain values.
    """
    content = _read(path)
    missing = {"obj_pose", "obj_path", "grasp_qpos"} - set(content)
    if missing:
        raise InputError(path, ", ".join(sorted(missing)), "is missing")
    qpos = np.asarray(content["grasp_qpos"], dtype=np.float64)
    length = POSE + len(hand.joints)
    if qpos.shape != (length,):
        raise InputError(path, "grasp_qpos", f"has shape {qpos.shape} instead of ({length},)")
    poses = from_position_quaternion(content["obj_pose"]), from_position_quaternion(qpos[:POSE])
    name, held = Path(str(content["obj_path"])).name, bool(content.get("succ_flag", True))
    return relative(name, hand, poses, qpos[POSE:], held)


def _turned(hand: Hand, positions: NDArray[np.float64], factor: float) -> NDArray[np.float64]:
    """Joint positions (J,) with those of closing joints scaled by a factor, within the limits."""
    turned = positions.copy()
    turned[[joint for finger in hand.fingers for joint in finger.joints]] *= factor
    return np.asarray(np.clip(turned, *hand.joint_limits.T))


def _read(path: str | Path) -> dict[str, Any]:
    with parsing(path, "is not a DexGraspBench grasp"), Path(path).open("rb") as file:
        np.lib.format.read_magic(file)
        np.lib.format.read_array_header_1_0(file)
        content = _ArrayUnpickler(file).load()
    content = content.item() if isinstance(content, np.ndarray) and content.ndim == 0 else content
    if not isinstance(content, dict):
        raise InputError(path, "", "does not contain a dictionary")
    return content
