"""The numbers of a hand_configuration, as in the published dataset."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

# The rank index and the pose; the hand's degrees of freedom follow.
POSE_LENGTH = 13


class HandConfiguration(NamedTuple):
    """Pose and degrees of freedom of a hand; leading dimensions are a batch."""

    rank_index: NDArray[np.int64]
    """(...,) position in the ranking by energy, 0 is the best."""
    T_object_hand: Array
    """(..., 4, 4) the hand's frame in the object's frame, metres."""
    dofs: Array
    """(..., D) in the order of `Hand.dof_names`, rad or m."""


def unpack(numbers: ArrayLike) -> HandConfiguration:
    """Unpack hand configurations (..., 13 + D): rank index, 3x4 pose row by row, D DOFs.

    Raises:
        ValueError: the last dimension has no room for a degree of freedom.
    """
    numbers = np.asarray(numbers, dtype=np.float64)
    if numbers.shape[-1] <= POSE_LENGTH:
        raise ValueError(
            f"a hand configuration has more than {POSE_LENGTH} numbers, not shape {numbers.shape}"
        )
    batch = numbers.shape[:-1]
    T_object_hand = np.broadcast_to(np.eye(4), (*batch, 4, 4)).copy()
    T_object_hand[..., :3, :] = numbers[..., 1:POSE_LENGTH].reshape(*batch, 3, 4)
    return HandConfiguration(
        numbers[..., 0].astype(np.int64), T_object_hand, numbers[..., POSE_LENGTH:].copy()
    )


def pack(rank_index: ArrayLike, T_object_hand: ArrayLike, dofs: ArrayLike) -> Array:
    """The 13 + D numbers of a pose (..., 4, 4) in metres and DOFs (..., D)."""
    T_object_hand, dofs = np.asarray(T_object_hand, dtype=np.float64), np.asarray(dofs)
    batch = T_object_hand.shape[:-2]
    rank = np.broadcast_to(np.asarray(rank_index, dtype=np.float64), batch)[..., None]
    rows = T_object_hand[..., :3, :].reshape(*batch, 12)
    return np.concatenate([rank, rows, np.broadcast_to(dofs, (*batch, dofs.shape[-1]))], axis=-1)
