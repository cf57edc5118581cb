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

    def centred(self) -> HandStates:
        """Hands that have given way until their fingers, which slide together, are equally closed.

        Each finger stays where it touches: the hand moves along its axis by what it closed too
        much.
        """
        hand, positions = self.hand, self.joint_positions.copy()
        joints = [finger.joints[0] for finger in hand.fingers]
        mean = positions[:, joints].mean(axis=1, keepdims=True)
        axes = hand.link_poses(positions)[:, [joint + 1 for joint in joints]][..., :3, 2]
        excess = positions[:, joints] - mean
        shift = np.einsum("nf,nfi->ni", excess, axes) / len(joints)
        positions[:, joints] = mean
        T_object_hand = self.T_object_hand.copy()
        T_object_hand[:, :3, 3] += np.einsum("nij,nj->ni", T_object_hand[:, :3, :3], shift)
        return HandStates(hand, T_object_hand, positions)
