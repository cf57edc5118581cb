"""What all exchange formats share: a hand's pose relative to an object and its joint angles.

Quaternions here and in the formats are w, x, y, z.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]


class PosedHands(NamedTuple):
    """n grasps of one object."""

    object_name: str
    T_object_hand: Array
    """(n, 4, 4) palm frame of `hand.kinematics` in the object frame, metres."""
    joint_angles_rad: Array
    """(n, 8) in the order of `kinematics.JOINT_NAMES`."""
    held: NDArray[np.bool_]
    """(n,) whether the grasp passed its test."""


def to_position_quaternion(T: ArrayLike) -> Array:
    """Poses (..., 4, 4) as x, y, z, then w, x, y, z (..., 7), w not negative."""
    T = np.asarray(T, dtype=np.float64)
    quaternion = Rotation.from_matrix(T[..., :3, :3]).as_quat(canonical=True, scalar_first=True)
    return np.concatenate([T[..., :3, 3], quaternion], axis=-1)


def from_position_quaternion(numbers: ArrayLike) -> Array:
    """Poses (..., 4, 4) of x, y, z, then w, x, y, z (..., 7), with a quaternion of any length.

    Raises:
        ValueError: not seven numbers, or a quaternion of length zero.
    """
    numbers = np.asarray(numbers, dtype=np.float64)
    if numbers.shape[-1:] != (7,):
        raise ValueError(f"a pose has 7 numbers, not shape {numbers.shape}")
    T = np.broadcast_to(np.eye(4), (*numbers.shape[:-1], 4, 4)).copy()
    T[..., :3, :3] = Rotation.from_quat(numbers[..., 3:], scalar_first=True).as_matrix()
    T[..., :3, 3] = numbers[..., :3]
    return T
