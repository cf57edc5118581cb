"""The test of one grasp: by geometry as planned, in physics, and by geometry as held."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.surface import depth_in_hand
from grasptypes.physics.engine import Contact
from grasptypes.physics.holding import HoldResult
from grasptypes.settings.physics import ValiditySettings
from grasptypes.synthesis.energy import closeness
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]

PhysicsTest = Callable[[Array, Array], HoldResult]


class GraspTrial(NamedTuple):
    """Result of trying one grasp."""

    reason: str
    """One of `grasps.REASONS`, or empty."""
    T_object_hand: Array
    """(4, 4): as held at the end, or as planned if not held."""
    joint_positions: Array
    """(J,) likewise."""
    penetration_m: float
    moved_m: float
    turned_rad: float
    contacts: list[Contact]
    bears_load: bool
    """Whether it held under the task's load."""
    stages: tuple[int, ...]
    """Number of stopped joints of each finger, as held at the end; none if not held."""
    T_object_touching: Array
    """(4, 4) the hand as planned: its fingers touch, and squeeze next."""
    touching_positions: Array
    """(J,) likewise."""
    deviation: float = 0.0
    """Deviation of that hand from the shape of the person's grip, see `preshape_cost`."""


class GraspTester:
    """Checks grasps geometrically, and tests those without a flaw in physics.

    Args:
        scene: scene with the fine hand.
        hold: the physics test, of a pose (4, 4) and joint positions (J,).
        others: tests in other engines. They cost most, so only a grasp that is held without a flaw
            takes them, and it must pass them all.
    """

    def __init__(
        self,
        scene: GraspScene,
        hold: PhysicsTest,
        validity: ValiditySettings,
        others: Sequence[PhysicsTest] = (),
    ) -> None:
        self.scene = scene
        self.hold = hold
        self.validity = validity
        self.others = others

    def try_grasp(self, T_object_hand: Array, joint_positions: Array) -> GraspTrial:
        """Check a grasp as planned; if it has no flaw, test it, and check it as held."""
        hand = self.scene.hand
        reason, depth = self._flaw(T_object_hand, joint_positions)
        touching = T_object_hand, joint_positions
        none = (0,) * len(hand.fingers)
        planned = GraspTrial(reason, *touching, depth, 0.0, 0.0, [], False, none, *touching)
        if reason:
            return planned
        held = self.hold(T_object_hand, joint_positions)
        moved = held.moved_m, held.turned_rad
        dropped = planned._replace(reason="dropped", moved_m=moved[0], turned_rad=moved[1])
        if held.dropped:
            return dropped
        # One motor moves all joints of a preshape, but the simulation has one each.
        shared = hand.preshaped(hand.preshape_of(held.joint_positions))
        closing = [joint for finger in hand.fingers for joint in finger.joints]
        shared[closing] = held.joint_positions[closing]
        positions = np.clip(shared, *hand.joint_limits.T)
        reason, depth = self._flaw(held.T_object_hand, positions)
        links = {contact.link for contact in held.contacts}
        if self._beyond_limits(held.joint_positions):
            reason = "joint_limit"
        elif not reason and len(links) < self.validity.min_links:
            reason = "no_contact"
        if not reason and any(test(*touching).dropped for test in self.others):
            return dropped
        state = held.T_object_hand, positions, depth, *moved, held.contacts
        return GraspTrial(reason, *state, held.bears_load, held.stages, *touching)

    def _flaw(self, T_object_hand: Array, positions: Array) -> tuple[str, float]:
        """Geometric flaw of a pose, and penetration depth of hand and object.

        Both the hand's points in the object and the object's points in the hand are checked,
        because a thin wall can cut into a link between the points of either.
        """
        hand = self.scene.hand
        poses = T_object_hand @ hand.link_poses(positions)
        close = closeness(self.scene, poses[None])
        in_hand = depth_in_hand(hand, self.scene.surface_m, poses)
        depth = max(float(close.penetration_m[0]), in_hand)
        if self._beyond_limits(positions):
            return "joint_limit", depth
        if close.self_depth_m[0] > self.validity.max_depth_m:
            return "self_collision", depth
        if depth > self.validity.max_depth_m:
            return "penetrates", depth
        touching = close.gaps_m[0, list(hand.finger_links)] <= self.validity.touch_m
        return ("" if touching.any() else "no_contact"), depth

    def _beyond_limits(self, positions: Array) -> bool:
        hand, validity = self.scene.hand, self.validity
        beyond = hand.beyond_limits(
            positions, validity.limit_tolerance_rad, validity.limit_tolerance_m
        )
        tolerance = np.where(
            hand.prismatic_joints, validity.lag_tolerance_m, validity.lag_tolerance_rad
        )
        return bool(beyond.any() or (hand.lag(positions) > tolerance).any())
