"""The 17 numbers of a hand_configuration, as in the published dataset."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

LENGTH = 17


class HandConfiguration(NamedTuple):
    """Pose and degrees of freedom of the hand; leading dimensions are a batch."""

    rank_index: NDArray[np.int64]
    """(...,) position in the ranking by energy, 0 is the best."""
    T_object_hand: Array
    """(..., 4, 4) the hand's frame in the object's frame, metres."""
    dofs_rad: Array
    """(..., 4) spread, F1, F2, F3 in radians, in the order of `kinematics.DOF_NAMES`."""


def unpack(numbers: ArrayLike) -> HandConfiguration:
    """Unpack hand configurations (..., 17): rank index, 3x4 pose row by row, four DOFs.

    Raises:
        ValueError: the last dimension is not 17.
    """
    numbers = np.asarray(numbers, dtype=np.float64)
    if numbers.shape[-1:] != (LENGTH,):
        raise ValueError(f"a hand configuration has {LENGTH} numbers, not shape {numbers.shape}")
    batch = numbers.shape[:-1]
    T_object_hand = np.broadcast_to(np.eye(4), (*batch, 4, 4)).copy()
    T_object_hand[..., :3, :] = numbers[..., 1:13].reshape(*batch, 3, 4)
    return HandConfiguration(
        numbers[..., 0].astype(np.int64), T_object_hand, numbers[..., 13:].copy()
    )


def pack(rank_index: ArrayLike, T_object_hand: ArrayLike, dofs_rad: ArrayLike) -> Array:
    """The 17 numbers (..., 17) of a pose (..., 4, 4) in metres and DOFs (..., 4) in radians."""
    T_object_hand = np.asarray(T_object_hand, dtype=np.float64)
    batch = T_object_hand.shape[:-2]
    rank = np.broadcast_to(np.asarray(rank_index, dtype=np.float64), batch)[..., None]
    rows = T_object_hand[..., :3, :].reshape(*batch, 12)
    return np.concatenate([rank, rows, np.broadcast_to(dofs_rad, (*batch, 4))], axis=-1)
