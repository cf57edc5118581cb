"""What testing a grasp takes and gives, and the hand's motors; no physics engine in here."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hand import kinematics

Array = NDArray[np.float64]

# A joint this far behind where it has been is being driven back: 0.1 mm at the fingertip.
DRIVEN_BACK_RAD = 0.001


class PhysicsSettings(NamedTuple):
    """How grasps are tested; the fields are keys of the `physics` section of params.yaml."""

    timestep_s: float
    solver_iterations: int
    friction: float
    gravity_m_s2: float
    control_steps: int
    """Time steps between two commands to the motors."""
    fingertip_force_n: float
    """Force at the fingertip up to which the motors close."""
    passive_force_n: float
    """Force at the fingertip that the stopped fingers withstand."""
    closing_speed_rad_s: float
    squeeze_time_s: float
    hold_time_s: float
    drop_distance_m: float
    """Movement in the hand from which an object counts as dropped."""
    drop_rotation_rad: float
    """The same for its rotation."""
    shake: bool
    """Whether gravity acts from all six sides in turn instead of along -z only."""


class Contact(NamedTuple):
    """A point where a link presses on the object, in the object's frame."""

    link: int
    """Index into `kinematics.LINK_NAMES`."""
    point_m: Array
    """(3,)."""
    normal: Array
    """(3,) unit vector from the link into the object."""
    force_n: float
    """Along the normal."""


class Held(NamedTuple):
    """What became of a grasp."""

    dropped: bool
    moved_m: float
    """How far the object moved in the hand while gravity acted; the worst direction counts."""
    turned_rad: float
    """How far it turned meanwhile."""
    T_object_hand: Array
    """(4, 4) at the end of the last test."""
    joint_angles_rad: Array
    """(8,) at the end of the last test."""
    contacts: list[Contact]
    """At the end of the last test."""


class Motors:
    """The hand's motors: they close with a limited force, and never let go.

    Worm gears keep a joint from being driven back: it withstands the hand's passive force. Base
    and tip of a finger close at the speeds of their coupling; either goes on alone when the other
    one is stopped, as the TorqueSwitch lets them.
    """

    def __init__(self, angles_rad: Array, settings: PhysicsSettings) -> None:
        levers = _levers_m(angles_rad)
        closing = np.repeat([0.0, 1.0, kinematics.DISTAL_RATIO], [2, 3, 3])
        self._speeds_rad_s = settings.closing_speed_rad_s * closing
        self._interval_s = settings.timestep_s * settings.control_steps
        self._closing_nm = settings.fingertip_force_n * levers
        self._passive_nm = settings.passive_force_n * levers
        self._reached_rad = angles_rad.copy()

    def drive(self, angles_rad: Array) -> tuple[Array, Array]:
        """What the motors do at joint angles (8,): speeds (8,) rad/s and torque limits (8,) N m."""
        moves = self._speeds_rad_s > 0
        self._reached_rad = np.where(
            moves, np.maximum(self._reached_rad, angles_rad), self._reached_rad
        )
        stop = kinematics.JOINT_LIMITS_RAD[:, 1]
        way = np.minimum(self._reached_rad, stop) - angles_rad
        closing = np.minimum(self._speeds_rad_s, (stop - angles_rad) / self._interval_s)
        withstands = ~moves | (way > DRIVEN_BACK_RAD) | (angles_rad > stop)
        return (
            np.where(withstands, way / self._interval_s, closing),
            np.where(withstands, self._passive_nm, self._closing_nm),
        )


def _levers_m(angles: Array) -> Array:
    """(8,) distance of each joint's axis from the fingertip it moves, metres."""
    poses = kinematics.link_poses(angles)[1:]
    tips = kinematics.fingertips(angles)[[0, 1, 0, 1, 2, 0, 1, 2]]
    way = tips - poses[:, :3, 3]
    return np.linalg.norm(np.cross(poses[:, :3, 2], way), axis=1)
