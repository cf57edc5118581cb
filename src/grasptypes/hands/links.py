"""What a hand is made of: links, the joints between them, and the fingers that these form.

Each link frame is at the joint that carries the link and moves with it; z is the joint's axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class ConvexPart(NamedTuple):
    """A convex solid in the frame of its link: corners (n, 3) metres, triangles (m, 3)."""

    name: str
    vertices_m: Array
    faces: NDArray[np.int64]


class Visual(NamedTuple):
    """The part of a link of one material: vertices (n, 3) m in its frame, triangles (m, 3)."""

    name: str
    material: str
    rgba: tuple[float, float, float, float]
    vertices_m: Array
    faces: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Link:
    """A rigid body.

    Attributes:
        parts: what collides.
        visuals: what is seen.
        centre_of_mass_m: (3,) in the link's frame.
        inertia_kg_m2: (3, 3) about the centre of mass, along the link's axes.
        friction: Coulomb coefficient.
    """

    name: str
    parts: tuple[ConvexPart, ...]
    visuals: tuple[Visual, ...]
    mass_kg: float
    centre_of_mass_m: Array
    inertia_kg_m2: Array
    friction: float


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint about, or along, the z axis of its child's frame.

    Attributes:
        parent: index of a link.
        T_parent_rest: (4, 4) the child's frame in the parent's at position zero, metres.
        limits: lowest and highest position; rad, or m if prismatic.
        effort: largest torque, N m, or force, N.
        speed: rad/s or m/s.
    """

    name: str
    parent: int
    prismatic: bool
    T_parent_rest: Array
    limits: tuple[float, float]
    effort: float
    speed: float


@dataclass(frozen=True, eq=False)
class Finger:
    """A chain that closes; see `description.FingerDescription`.

    Attributes:
        joints: indices of its closing joints, from the palm outwards.
        open: (m,) positions from which they close.
        rates: (m, m) row s: relative speeds after s joints have been stopped.
        bend_rad: (m,) exterior angles at position zero.
        tip_m: (3,) end of the last link, in its frame.
    """

    name: str
    joints: tuple[int, ...]
    open: Array
    rates: Array
    bend_rad: Array
    half_thickness_m: float
    tip_m: Array
    thumb: bool

    @property
    def links(self) -> tuple[int, ...]:
        """Indices of its closing links, from the palm outwards."""
        return tuple(joint + 1 for joint in self.joints)
