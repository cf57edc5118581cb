"""Input and output of the physics test, and the hand's motors; without a physics engine."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hand import kinematics
from grasptypes.settings.physics import PhysicsSettings

Array = NDArray[np.float64]

# A joint this far behind its previous angle is being driven back: 0.1 mm at the fingertip.
DRIVEN_BACK_RAD = 0.001
# The joints of the three fingers in `kinematics.JOINT_NAMES`.
BASES, TIPS = slice(2, 5), slice(5, 8)


class Contact(NamedTuple):
    """A point where a link presses on the object, in the object frame."""

    link: int
    """Index into `kinematics.LINK_NAMES`."""
    point_m: Array
    """(3,)."""
    normal: Array
    """(3,) unit vector from the link into the object."""
    force_n: float
    """Along the normal."""


class HoldResult(NamedTuple):
    """Result of a physics test.

    With `shake`, all fields are of the test in the worst direction of gravity: the first in which
    the object dropped, or the one in which it moved most.
    """

    dropped: bool
    moved_m: float
    """Motion of the object's centre of mass in the hand under gravity."""
    turned_rad: float
    """Rotation of the object in the hand under gravity."""
    T_object_hand: Array
    """(4, 4) at the end of the last test."""
    joint_angles_rad: Array
    """(8,) at the end of the last test."""
    contacts: list[Contact]
    """At the end of the last test."""


class Motors:
    """The hand's motors: they close with a limited force and never let go.

    Worm gears keep joints from being driven back, up to the hand's passive force. One motor turns
    base and tip of a finger, coupled three to one, until the base is stopped by a contact; then the
    TorqueSwitch releases it and the tip goes on alone.
    """

    def __init__(self, angles_rad: Array, settings: PhysicsSettings) -> None:
        self.coupled: NDArray[np.bool_] = np.abs(kinematics.lag(angles_rad)) < DRIVEN_BACK_RAD
        """(3,) fingers whose base and tip still turn together."""
        self._settings = settings
        self._interval_s = settings.timestep_s * settings.control_steps
        self._reached_rad = angles_rad.copy()
        self._levers_m = _levers_m(angles_rad, self.coupled)

    def release(self, finger: int) -> None:
        """From now on, the base of a finger (0 to 2) stays in place and the tip closes alone."""
        self.coupled[finger] = False
        self._levers_m = _levers_m(self._reached_rad, self.coupled)

    def drive(self, angles_rad: Array) -> tuple[Array, Array]:
        """Motor commands at joint angles (8,): speeds (8,) rad/s and torque limits (8,) N m.

        The tip of a coupled finger has no torque of its own.
        """
        ratio = kinematics.DISTAL_RATIO
        tips = np.where(self.coupled, ratio, 1.0 + ratio)
        speeds = self._settings.closing_speed_rad_s * np.concatenate([[0, 0], self.coupled, tips])
        moves = np.arange(len(angles_rad)) >= BASES.start
        moves[BASES] = self.coupled
        self._reached_rad = np.where(
            moves, np.maximum(self._reached_rad, angles_rad), self._reached_rad
        )
        stop = kinematics.JOINT_LIMITS_RAD[:, 1]
        way = np.minimum(self._reached_rad, stop) - angles_rad
        closing = np.minimum(speeds, (stop - angles_rad) / self._interval_s)
        withstands = ~moves | (way > DRIVEN_BACK_RAD) | (angles_rad > stop)
        withstands[BASES] |= ~self.coupled
        force_n = np.where(
            withstands, self._settings.passive_force_n, self._settings.fingertip_force_n
        )
        force_n[TIPS] = np.where(self.coupled, 0.0, force_n[TIPS])
        return np.where(withstands, way / self._interval_s, closing), force_n * self._levers_m


def _levers_m(angles: Array, coupled: NDArray[np.bool_]) -> Array:
    """(8,) motion of the fingertip per joint motion, metres per radian."""
    poses = kinematics.link_poses(angles)[1:]
    tips = kinematics.fingertips(angles)[[0, 1, 0, 1, 2, 0, 1, 2]]
    ways = np.cross(poses[:, :3, 2], tips - poses[:, :3, 3])
    ways[BASES] += kinematics.DISTAL_RATIO * coupled[:, None] * ways[TIPS]
    return np.asarray(np.linalg.norm(ways, axis=1))
