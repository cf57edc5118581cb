"""What all exchange formats share: a hand's pose relative to an object and its joint positions.

Quaternions here and in the formats are w, x, y, z.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import RigidTransform, Rotation

from grasptypes.hands.hand import Hand

Array = NDArray[np.float64]


class PosedHands(NamedTuple):
    """n grasps of one object."""

    object_name: str
    hand: Hand
    T_object_hand: RigidTransform
    """n hand frames in the object frame, metres."""
    joint_positions: Array
    """(n, J) in the order of `Hand.joints`; rad, prismatic joints m."""
    held: NDArray[np.bool_]
    """(n,) whether the grasp passed its test."""


def to_position_quaternion(T: RigidTransform) -> Array:
    """Poses as x, y, z, then w, x, y, z (..., 7), w not negative."""
    quaternion = T.rotation.as_quat(canonical=True, scalar_first=True)
    return np.concatenate([T.translation, quaternion], axis=-1)


def from_position_quaternion(numbers: ArrayLike) -> RigidTransform:
    """Poses of x, y, z, then w, x, y, z (..., 7), with a quaternion of any length.

    Raises:
        ValueError: not seven numbers, or a quaternion of length zero.
    """
    numbers = np.asarray(numbers, dtype=np.float64)
    if numbers.shape[-1:] != (7,):
        raise ValueError(f"a pose has 7 numbers, not shape {numbers.shape}")
    rotation = Rotation.from_quat(numbers[..., 3:], scalar_first=True)
    return RigidTransform.from_components(numbers[..., :3], rotation)


def relative(
    object_name: str,
    hand: Hand,
    T_world: tuple[RigidTransform, RigidTransform],
    positions: Array,
    held: bool,
) -> PosedHands:
    """A single grasp, given object and hand in the world and the joint positions (J,)."""
    T_world_object, T_world_hand = T_world
    T_object_hand = T_world_object.inv() * T_world_hand
    poses = RigidTransform(T_object_hand.as_matrix()[None], normalize=False)
    return PosedHands(object_name, hand, poses, positions[None], np.array([held]))
