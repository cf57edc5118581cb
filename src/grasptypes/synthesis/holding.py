"""Input and output of the physics test, and the hand's motors; without a physics engine."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.hand import Finger, Hand
from grasptypes.settings.physics import PhysicsSettings

Array = NDArray[np.float64]

# A joint this far behind its previous position is being driven back: 0.1 mm at the fingertip.
DRIVEN_BACK_RAD, DRIVEN_BACK_M = 0.001, 0.0001


class Contact(NamedTuple):
    """A point where a link presses on the object, in the object frame."""

    link: int
    """Index into `Hand.links`."""
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
    joint_positions: Array
    """(J,) at the end of the last test."""
    contacts: list[Contact]
    """At the end of the last test."""


class Motors:
    """A hand's motors: they close with a limited force and never let go.

    Joints withstand being driven back, up to the hand's passive force. In coupled hands, one motor
    moves all joints of a finger at fixed rates until a link is stopped by a contact; then that
    joint and those before it stay, and the others go on alone.
    """

    def __init__(self, hand: Hand, positions: Array, settings: PhysicsSettings) -> None:
        self.hand = hand
        self._driven_back = np.where(hand.prismatic_joints, DRIVEN_BACK_M, DRIVEN_BACK_RAD)
        ahead = np.abs(hand.lag(positions)) >= self._driven_back
        self.stages = [_stage(finger, ahead) for finger in hand.fingers]
        """Number of stopped joints of each finger."""
        self._interval_s = settings.timestep_s * settings.control_steps
        self._reached = positions.copy()
        self._levers = self._tip_levers(positions)

    def stop(self, finger: int, count: int) -> None:
        """From now on, the first `count` joints of a finger stay in place."""
        self.stages[finger] = count
        self._levers = self._tip_levers(self._reached)

    def drive(self, positions: Array) -> tuple[Array, Array]:
        """Motor commands at joint positions (J,): speeds (J,) and torque limits (J,).

        Joints that follow another one of their finger have no torque of their own.
        """
        hand, motors = self.hand, self.hand.motors
        speeds, moves = np.zeros(len(positions)), np.zeros(len(positions), dtype=bool)
        follows = np.zeros(len(positions), dtype=bool)
        for finger, stage in zip(hand.fingers, self.stages, strict=True):
            joints = list(finger.joints)
            if stage == len(joints):
                continue
            # The motor keeps its speed: joints that go on alone turn faster.
            whole, left = np.abs(finger.rates[[0, stage]]).sum(axis=1)
            share = whole / left
            speeds[joints] = motors.closing_speed_rad_s * (finger.rates[stage] * share)
            moves[joints] = finger.rates[stage] != 0.0
            follows[joints[stage + 1 :]] = not hand.direct
        moves_on = np.where(speeds < 0.0, positions, np.maximum(self._reached, positions))
        self._reached = np.where(moves, moves_on, self._reached)
        stop = hand.joint_limits[:, 1]
        way = np.minimum(self._reached, stop) - positions
        closing = np.minimum(speeds, (stop - positions) / self._interval_s)
        withstands = ~moves | (way > self._driven_back) | (positions > stop)
        force_n = np.where(withstands, motors.passive_force_n, motors.fingertip_force_n)
        force_n[follows & moves] = 0.0
        return np.where(withstands, way / self._interval_s, closing), force_n * self._levers

    def _tip_levers(self, positions: Array) -> Array:
        """(J,) motion of the fingertips per joint motion: m/rad, 1 if prismatic.

        The joint of a preshape may carry several fingers: that with the largest motion counts.
        """
        hand = self.hand
        poses, tips = hand.link_poses(positions), hand.fingertips(positions)
        ways = np.zeros((len(hand.fingers), len(hand.joints), 3))
        for finger, stage, tip, way in zip(hand.fingers, self.stages, tips, ways, strict=True):
            for link in hand.path(finger):
                axis, origin = poses[link, :3, 2], poses[link, :3, 3]
                slides = hand.joints[link - 1].prismatic
                way[link - 1] = axis if slides else np.cross(axis, tip - origin)
            if hand.direct or stage == len(finger.joints):
                continue
            driver, *followers = finger.joints[stage:]
            for place, joint in enumerate(followers, start=stage + 1):
                ratio = finger.rates[stage, place] / finger.rates[stage, stage]
                way[driver] += ratio * way[joint]
        return np.asarray(np.linalg.norm(ways, axis=2).max(axis=0))


def _stage(finger: Finger, ahead: NDArray[np.bool_]) -> int:
    """Number of joints of a finger that have been stopped before its last joint that moved on.

    Args:
        ahead: (J,) whether a joint has left the coupled motion.
    """
    return int(np.flatnonzero(ahead[list(finger.joints)]).max(initial=0))
