"""Rigid transforms as (4, 4) matrices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def inverse(T: Array) -> Array:
    """Inverses of rigid transforms (..., 4, 4)."""
    result = np.zeros_like(T)
    turned = np.swapaxes(T[..., :3, :3], -1, -2)
    result[..., :3, :3] = turned
    result[..., :3, 3] = -np.einsum("...ij,...j->...i", turned, T[..., :3, 3])
    result[..., 3, 3] = 1.0
    return result
