"""Where hands are and how far they are closed, many at once."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hand import kinematics

Array = NDArray[np.float64]


class HandStates(NamedTuple):
    """n hands in the object's frame."""

    T_object_hand: Array
    """(n, 4, 4) metres."""
    joint_angles_rad: Array
    """(n, 8) in the order of `kinematics.JOINT_NAMES`."""

    def take(self, index: NDArray[Any]) -> HandStates:
        """Those of an index or mask."""
        return HandStates(self.T_object_hand[index], self.joint_angles_rad[index])

    def link_poses(self) -> Array:
        """T_object_link (n, 9, 4, 4) in the order of `kinematics.LINK_NAMES`."""
        return self.T_object_hand[:, None] @ kinematics.link_poses(self.joint_angles_rad)
