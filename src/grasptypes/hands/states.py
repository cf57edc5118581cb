"""Where hands are and how far they are closed, many at once."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.hand import Hand

Array = NDArray[np.float64]


class HandStates(NamedTuple):
    """n states of one hand in the object's frame."""

    hand: Hand
    T_object_hand: Array
    """(n, 4, 4) metres."""
    joint_positions: Array
    """(n, J) in the order of `Hand.joints`; rad, prismatic joints m."""

    @property
    def preshape(self) -> Array:
        """(n, P) preshapes."""
        return self.hand.preshape_of(self.joint_positions)

    def take(self, index: NDArray[Any]) -> HandStates:
        """Those of an index or mask."""
        return HandStates(self.hand, self.T_object_hand[index], self.joint_positions[index])

    def link_poses(self) -> Array:
        """T_object_link (n, L, 4, 4) in the order of `Hand.links`."""
        return self.T_object_hand[:, None] @ self.hand.link_poses(self.joint_positions)
