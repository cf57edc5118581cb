"""A hand's motors; without a physics engine."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.hand import Hand
from grasptypes.hands.links import Finger
from grasptypes.settings.physics import PhysicsSettings

Array = NDArray[np.float64]

# A joint this far ahead of its coupling has been released: 0.1 mm at the fingertip.
RELEASED_RAD, RELEASED_M = 0.001, 0.0001


class MotorCommand(NamedTuple):
    """What the motors do until the next command; (J,) each, rad and N m, or m and N."""

    speeds: Array
    """Speeds at which joints close; 0 for those that stay where they are."""
    closing_torques: Array
    """Torques for it; 0 for joints that stay or follow another one."""
    passive_torques: Array
    """Largest torques that withstand being driven back; 0 for joints that follow another one."""
    reached: Array
    """Positions from which joints withstand being driven back."""


def grip_forces(hand: Hand, mass_kg: float, settings: PhysicsSettings) -> Array:
    """(F,) forces of the fingertips that hold an object, newtons.

    They follow the weight, between the gentle and the rated force of the hand's description. The
    fingers together press with no more than a share of what the thumbs withstand: otherwise they
    would push the thumbs back, and the object after them.
    """
    motors = hand.motors
    weight_n = mass_kg * settings.gravity_m_s2
    wanted_n = max(motors.fingertip_force_n, settings.grip_weights * weight_n)
    force_n = min(wanted_n, motors.rated_force_n or motors.fingertip_force_n)
    thumbs = np.array([finger.thumb for finger in hand.fingers])
    borne_n = settings.thumb_share * motors.passive_force_n * thumbs.sum() / (~thumbs).sum()
    return np.where(thumbs, force_n, min(force_n, borne_n))


class Motors:
    """A hand's motors: they close with a limited force and never let go.

    Joints withstand being driven back, up to the hand's passive force. In coupled hands, one motor
    moves all joints of a finger at fixed rates until a link is stopped by a contact; then that
    joint and those before it stay, and the others go on alone.
    """

    def __init__(
        self,
        hand: Hand,
        positions: Array,
        forces_n: Array,
        stages: Sequence[int] | None = None,
    ) -> None:
        self.hand = hand
        self._forces_n = np.zeros(len(positions))
        for finger, force_n in zip(hand.fingers, forces_n, strict=True):
            self._forces_n[list(finger.joints)] = force_n
        released = np.where(hand.prismatic_joints, RELEASED_M, RELEASED_RAD)
        ahead = np.abs(hand.lag(positions)) >= released
        shown = (_stage(finger, ahead) for finger in hand.fingers)
        self.stages = list(shown if stages is None else stages)
        """Number of stopped joints of each finger."""
        self._reached = positions.copy()
        self._set_command()

    def stop(self, finger: int, count: int) -> None:
        """From now on, the first `count` joints of a finger stay in place."""
        self.stages[finger] = count
        self._set_command()

    def drive(self, positions: Array) -> MotorCommand:
        """The motors' command at joint positions (J,)."""
        speeds, closes = self._command.speeds, self._closes
        moves_on = np.where(speeds < 0.0, positions, np.maximum(self._reached, positions))
        self._reached = np.where(closes, moves_on, self._reached)
        reached = np.minimum(self._reached, self.hand.joint_limits[:, 1])
        return self._command._replace(reached=reached)

    def _set_command(self) -> None:
        """Set what the motors do until the next joint stops.

        Joints that follow another one of their finger have no torque of their own.
        """
        hand, motors, count = self.hand, self.hand.motors, len(self._reached)
        speeds, moves = np.zeros(count), np.zeros(count, dtype=bool)
        follows = np.zeros(count, dtype=bool)
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
        levers = tip_levers(hand, self.stages, self._reached)
        levers = np.where(follows & moves, 0.0, levers)
        self._closes = moves
        self._command = MotorCommand(
            speeds=speeds,
            closing_torques=np.where(moves, self._forces_n * levers, 0.0),
            passive_torques=np.maximum(motors.passive_force_n, self._forces_n) * levers,
            reached=self._reached,
        )


def tip_levers(hand: Hand, stages: Sequence[int], positions: Array) -> Array:
    """(J,) motion of the fingertips per joint motion: m/rad, 1 if prismatic.

    The joint of a preshape may carry several fingers: that with the largest motion counts.

    Args:
        stages: number of stopped joints of each finger.
        positions: (J,).
    """
    poses, tips = hand.link_poses(positions), hand.fingertips(positions)
    ways = np.zeros((len(hand.fingers), len(hand.joints), 3))
    for finger, stage, tip, way in zip(hand.fingers, stages, tips, ways, strict=True):
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
