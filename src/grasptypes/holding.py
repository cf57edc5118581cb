"""What testing a grasp takes and gives, and the hand's motors; no physics engine in here."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hand import kinematics

Array = NDArray[np.float64]


class PhysicsSettings(NamedTuple):
    """How grasps are tested; the fields are keys of the `physics` section of params.yaml."""

    timestep_s: float
    solver_iterations: int
    friction: float
    gravity_m_s2: float
    control_steps: int
    """Time steps between two looks at the motors' torques."""
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
    """The hand's motors: they close a joint until it takes their torque, and never let go.

    The worm gears hold a stopped joint with the hand's passive force. Base and tip of a finger
    advance at the speeds of their coupling; either goes on alone when the other one is stopped.
    """

    def __init__(self, angles_rad: Array, settings: PhysicsSettings) -> None:
        levers = _levers_m(angles_rad)
        step = settings.closing_speed_rad_s * settings.timestep_s * settings.control_steps
        self.targets_rad = angles_rad.copy()
        self.limits_nm = settings.passive_force_n * levers
        self._closing_nm = settings.fingertip_force_n * levers
        self._steps_rad = step * np.repeat([0.0, 1.0, kinematics.DISTAL_RATIO], [2, 3, 3])

    def advance(self, torques_nm: Array) -> None:
        """Move the targets (8,) of the joints whose motors feel less than their closing torque."""
        free = np.abs(torques_nm) < self._closing_nm
        upper = kinematics.JOINT_LIMITS_RAD[:, 1]
        self.targets_rad = np.minimum(self.targets_rad + free * self._steps_rad, upper)


def _levers_m(angles: Array) -> Array:
    """(8,) distance of each joint's axis from the fingertip it moves, metres."""
    poses = kinematics.link_poses(angles)[1:]
    tips = kinematics.fingertips(angles)[[0, 1, 0, 1, 2, 0, 1, 2]]
    way = tips - poses[:, :3, 3]
    return np.linalg.norm(np.cross(poses[:, :3, 2], way), axis=1)
