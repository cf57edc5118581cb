"""What a test of grasps needs from a physics engine; `engines` has those that provide it.

An engine holds one world: the hand, whose fixed frame is the world's, and the free object. Loading
makes the world anew, in the same order, so that no result depends on earlier tests.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.hand import Hand
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.physics.motors import MotorCommand
from grasptypes.settings.physics import PhysicsSettings

Array = NDArray[np.float64]


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


class Surroundings(NamedTuple):
    """What differs from the nominal test."""

    friction: float | None = None
    """Coulomb coefficient; that of the settings if there is none."""
    mass_share: float = 1.0
    """Mass and inertia of the object relative to its properties."""


NOMINAL = Surroundings()


class Engine(Protocol):
    """A physics engine with one hand and one object."""

    hand: Hand
    geometry: ObjectGeometry
    settings: PhysicsSettings
    steps: int
    """Number of time steps so far, for benchmarks."""

    def load(
        self, T_object_hand: Array, joint_positions: Array, world: Surroundings = NOMINAL
    ) -> None:
        """Create the world: a hand at a pose (4, 4) at rest, (J,) joints, without gravity."""

    def accelerate(self, gravity_m_s2: Array) -> None:
        """Set the acceleration (3,) of gravity, in the hand's frame."""

    def push(self, force_n: Array, point_m: Array) -> None:
        """Let a force (3,), in the hand's frame, act at a point (3,) of the object's frame."""

    def couple(self, finger: int, stage: int) -> None:
        """Let a finger's joints that still move, after `stage` stopped ones, follow the first."""

    def presses(self, link: int) -> bool:
        """Whether a link presses on the object."""

    def drive(self, command: MotorCommand) -> None:
        """Command the motors until the next command."""

    def step(self, count: int) -> None:
        """Simulate `count` time steps."""

    def joint_positions(self) -> Array:
        """(J,) rad, prismatic joints m."""

    def T_hand_object(self) -> Array:
        """(4, 4) the object's frame in the hand's."""

    def contacts(self) -> list[Contact]:
        """Where the hand presses on the object."""
