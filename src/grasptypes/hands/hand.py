"""A robot hand, and its batched forward kinematics.

The origin of a hand's frame is on its palm, +z is the palm normal (the approach), and thumbs are
at -y. Positive motion closes a finger.

Links and joints are in this order: the palm; links that move with a preshape only; then the first
closing link of every finger, the second of every finger, and so on. Joint i carries link i + 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from grasptypes.hands.description import ExchangeDescription, Grips, MotorDescription
from grasptypes.hands.links import Finger, Joint, Link

Array = NDArray[np.float64]
PALM = 0
"""Index of the palm in `Hand.links`."""


@dataclass(frozen=True, eq=False)
class Hand:
    """A hand; `reading.load_hand` reads one.

    Attributes:
        folder: where its description is.
        title: name as printed.
        links, joints: in the order of the module's description.
        preshape: joints that each preshape moves, with factors, by name.
        fingers: in the order of the description.
        direct: whether each joint has a motor of its own.
        self_centring: whether the fingers move together; then the hand gives way sideways.
        ends_at_hand: whether the palm and fingers closed before stop those that miss the object.
        solver_iterations: iterations per time step that a physics engine needs.
        ignored_pairs: pairs of links whose contact does not count.
    """

    folder: str
    title: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    preshape: dict[str, dict[int, float]]
    fingers: tuple[Finger, ...]
    direct: bool
    self_centring: bool
    ends_at_hand: bool
    motors: MotorDescription
    solver_iterations: int
    ignored_pairs: frozenset[tuple[int, int]]
    grips: Grips
    exchange: ExchangeDescription

    @cached_property
    def link_names(self) -> tuple[str, ...]:
        """Names of the links."""
        return tuple(link.name for link in self.links)

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints."""
        return tuple(joint.name for joint in self.joints)

    @cached_property
    def dof_names(self) -> tuple[str, ...]:
        """Degrees of freedom of a configuration: preshapes, then fingers."""
        return (*self.preshape, *(finger.name for finger in self.fingers))

    @cached_property
    def joint_limits(self) -> Array:
        """(J, 2) lowest and highest joint positions; rad or m."""
        return np.array([joint.limits for joint in self.joints])

    @cached_property
    def dof_limits(self) -> Array:
        """(D, 2) limits of the degrees of freedom: those of a finger are its first joint's."""
        limits = [
            np.array([np.sort(self.joint_limits[j] / factor) for j, factor in joints.items()])
            for joints in map(_turned, self.preshape.values())
        ]
        ends = [[ends[:, 0].max(), ends[:, 1].min()] for ends in limits]
        return np.array([*ends, *(self.joint_limits[f.joints[0]] for f in self.fingers)])

    @cached_property
    def prismatic_joints(self) -> NDArray[np.bool_]:
        """(J,) which joints have positions in metres."""
        return np.array([joint.prismatic for joint in self.joints])

    @cached_property
    def prismatic_dofs(self) -> NDArray[np.bool_]:
        """(D,) which degrees of freedom are in metres."""
        shared = [next(iter(_turned(joints))) for joints in self.preshape.values()]
        return self.prismatic_joints[[*shared, *(f.joints[0] for f in self.fingers)]]

    @cached_property
    def finger_links(self) -> tuple[int, ...]:
        """Indices of all closing links, ascending."""
        return tuple(sorted(link for finger in self.fingers for link in finger.links))

    @cached_property
    def tip_links(self) -> tuple[int, ...]:
        """Index of each finger's last link."""
        return tuple(finger.links[-1] for finger in self.fingers)

    @cached_property
    def finger_length_m(self) -> float:
        """Mean length of the fingers, from the first closing joint along the links to the tip."""
        lengths = [
            sum(
                float(np.linalg.norm(self.joints[joint].T_parent_rest[:3, 3]))
                for joint in finger.joints[1:]
            )
            + float(np.linalg.norm(finger.tip_m))
            for finger in self.fingers
        ]
        return sum(lengths) / len(lengths)

    def path(self, finger: Finger) -> tuple[int, ...]:
        """Indices of all moving links from a finger's tip to the palm, which is left out."""
        found, link = [], finger.links[-1]
        while link != PALM:
            found.append(link)
            link = self.joints[link - 1].parent
        return tuple(found)

    def preshaped(self, preshape: ArrayLike) -> Array:
        """Joint positions (..., J) of a hand with a preshape (..., P) and closing joints at 0."""
        preshape = np.asarray(preshape, dtype=np.float64)
        positions = np.zeros((*preshape.shape[:-1], len(self.joints)))
        for dof, joints in enumerate(self.preshape.values()):
            for joint, factor in joints.items():
                positions[..., joint] = factor * preshape[..., dof]
        return positions

    def opened(self, preshape: ArrayLike) -> Array:
        """Joint positions (..., J) of an open hand with a preshape (..., P)."""
        positions = self.preshaped(preshape)
        for finger in self.fingers:
            positions[..., list(finger.joints)] = finger.open
        return positions

    def preshape_of(self, positions: Array) -> Array:
        """Preshape (..., P) of joint positions (..., J); joints that share one count alike."""
        values = np.empty((*positions.shape[:-1], len(self.preshape)))
        for dof, joints in enumerate(self.preshape.values()):
            turned = _turned(joints)
            columns, factors = list(turned), np.array(list(turned.values()))
            values[..., dof] = (positions[..., columns] / factors).mean(axis=-1)
        return values

    def dofs_of(self, positions: Array) -> Array:
        """Degrees of freedom (..., D): preshapes, and each finger's first closing joint."""
        first = [finger.joints[0] for finger in self.fingers]
        return np.concatenate([self.preshape_of(positions), positions[..., first]], axis=-1)

    def couple(self, dofs: ArrayLike) -> Array:
        """All joint positions (..., J) of a hand whose fingers have closed without a stop.

        Args:
            dofs: (..., D) in the order of `dof_names`; rad or m.
        """
        dofs = np.asarray(dofs, dtype=np.float64)
        count = len(self.preshape)
        positions = self.preshaped(dofs[..., :count])
        for index, finger in enumerate(self.fingers):
            first = dofs[..., count + index] - finger.open[0]
            for place, joint in enumerate(finger.joints):
                ratio = finger.rates[0, place] / finger.rates[0, 0]
                positions[..., joint] = finger.open[place] + first * ratio
        return positions

    def link_poses(self, joint_positions: ArrayLike) -> Array:
        """Poses of all links in the hand's frame.

        Args:
            joint_positions: (..., J) rad, prismatic joints m.

        Returns:
            T_hand_link (..., L, 4, 4), metres. Column 2 of a pose is the joint axis and column 3 a
            point on it, as needed for a Jacobian.
        """
        positions = np.asarray(joint_positions, dtype=np.float64)
        cosine, sine = np.cos(positions), np.sin(positions)
        poses = np.empty((*positions.shape[:-1], len(self.links), 4, 4))
        poses[..., PALM, :, :] = np.eye(4)
        for index, joint in enumerate(self.joints):
            rest = poses[..., joint.parent, :, :] @ joint.T_parent_rest
            child = poses[..., index + 1, :, :]
            if joint.prismatic:
                child[...] = rest
                child[..., :3, 3] += positions[..., index, None] * rest[..., :3, 2]
                continue
            c, s = cosine[..., index, None], sine[..., index, None]
            child[..., 0] = rest[..., 0] * c + rest[..., 1] * s
            child[..., 1] = rest[..., 1] * c - rest[..., 0] * s
            child[..., 2:] = rest[..., 2:]
        return poses

    def fingertips(self, joint_positions: ArrayLike) -> Array:
        """Ends of the fingers in the hand's frame: (..., J) to (..., F, 3) metres."""
        poses = self.link_poses(joint_positions)[..., list(self.tip_links), :, :]
        tips = np.stack([finger.tip_m for finger in self.fingers])
        return np.asarray(
            np.einsum("...fij,fj->...fi", poses[..., :3, :3], tips) + poses[..., :3, 3]
        )

    def lag(self, joint_positions: ArrayLike) -> Array:
        """How far each closing joint is behind the motion that its coupled finger prescribes.

        Args:
            joint_positions: (..., J) rad or m.

        Returns:
            (..., J), negative where a stop has let a joint move ahead; 0 for the first joint of a
            finger, for preshapes, and for hands with a motor a joint.
        """
        positions = np.asarray(joint_positions, dtype=np.float64)
        lag = np.zeros_like(positions)
        if self.direct:
            return lag
        for finger in self.fingers:
            done = np.zeros((*positions.shape[:-1], len(finger.joints)))
            for place, joint in enumerate(finger.joints):
                ahead = finger.open[place] + done[..., place] - positions[..., joint]
                if place:
                    lag[..., joint] = ahead
                travel = -ahead / finger.rates[place, place]
                done += travel[..., None] * finger.rates[place]
        return lag

    def beyond_limits(
        self, joint_positions: ArrayLike, tolerance_rad: float, tolerance_m: float = 0.0
    ) -> NDArray[np.bool_]:
        """Which joint positions (..., J) exceed the limits by more than a tolerance.

        Args:
            tolerance_rad: of revolute joints.
            tolerance_m: of prismatic joints.
        """
        tolerance = np.where(self.prismatic_joints, tolerance_m, tolerance_rad)
        return beyond(joint_positions, self.joint_limits, tolerance)


def _turned(joints: dict[int, float]) -> dict[int, float]:
    """The joints that a preshape turns, without those that it keeps at 0."""
    return {joint: factor for joint, factor in joints.items() if factor}


def beyond(values: ArrayLike, limits: Array, tolerance: ArrayLike) -> NDArray[np.bool_]:
    """Which values (..., n) lie outside limits (n, 2) by more than tolerances (n,)."""
    values, tolerance = np.asarray(values, np.float64), np.asarray(tolerance, np.float64)
    return np.asarray((values < limits[:, 0] - tolerance) | (values > limits[:, 1] + tolerance))
