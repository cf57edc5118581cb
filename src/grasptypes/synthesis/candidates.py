"""Grasp candidates guided by one session's contact: the first step of ContactGrasp.

Half of them follow the person: the palm approaches like the person's and the fingers close where
the person's did. The others approach along the normals at touched points, with any roll, because
this hand is not a human one and may hold the same place better from another side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.states import HandStates
from grasptypes.settings.synthesis import CandidateSettings, ClosingSettings
from grasptypes.synthesis.approach import slide_in
from grasptypes.synthesis.closing import close_fingers
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Demonstration:
    """One session's contact and placement of the hand, in the object frame.

    Attributes:
        points_m, normals: (N, 3) points spread over the surface, and their outward normals.
        contact: (N,) 0 to 1.
        grip: one of the hand's grips.
        approach: (3,) unit vector along which the palm approached.
        closing: (3,) unit vector, from the thumb to the fingers.
        centre_m: (3,) between palm, fingers and thumb.
    """

    points_m: Array
    normals: Array
    contact: Array
    grip: str
    approach: Array
    closing: Array
    centre_m: Array


def draw_candidates(
    scene: GraspScene,
    demonstration: Demonstration,
    settings: CandidateSettings,
    closing: ClosingSettings,
    draw: np.random.Generator,
) -> HandStates:
    """Hands that have approached the object and closed their fingers."""
    count = settings.number
    followers = draw.random(count) < settings.follow_share
    aim, approach, side = _aims(demonstration, followers, settings, draw)
    grips = scene.hand.grips
    grip = grips.named(demonstration.grip)
    preshape = np.array(grip.preshapes)[draw.choice(len(grip.preshapes), count)]
    distance = draw.choice(grip.palm_distances_m, count)
    T = np.zeros((count, 4, 4))
    T[:, :3, :3] = frames(approach, side)
    foremost = (demonstration.points_m @ approach.T).min(axis=0)
    start = np.einsum("ni,ni->n", aim, approach) - foremost + grips.start_m
    T[:, :3, 3] = aim - start[:, None] * approach
    T[:, 3, 3] = 1.0
    moved = slide_in(scene, T, preshape, start - distance, closing.touch_m)
    touched = moved < start - distance - closing.touch_m
    moved -= touched * draw.choice(settings.back_offs_m, count)
    T[:, :3, 3] += moved[:, None] * approach
    return close_fingers(scene, T, preshape, closing)


def pregrasp(
    scene: GraspScene, T_object_hand: Array, joint_positions: Array
) -> tuple[Array, Array]:
    """The open hand in front of the object from which a grasp is reached along its approach.

    Args:
        T_object_hand: (4, 4) the hand at the object.
        joint_positions: (J,) there.

    Returns:
        T_object_hand (4, 4) and joint positions (J,) of the open hand.
    """
    hand, approach = scene.hand, T_object_hand[:3, 2]
    foremost = float((scene.surface_m @ approach).min())
    back_m = float(T_object_hand[:3, 3] @ approach) - foremost + hand.grips.start_m
    T = T_object_hand.copy()
    T[:3, 3] -= max(back_m, 0.0) * approach
    return T, hand.opened(hand.preshape_of(joint_positions))


def frames(approach: Array, side: Array) -> Array:
    """Rotations (n, 3, 3) with z along the approach (n, 3) and y closest to side (n, 3)."""
    z = approach / np.linalg.norm(approach, axis=1, keepdims=True)
    y = side - np.einsum("ni,ni->n", side, z)[:, None] * z
    y /= np.linalg.norm(y, axis=1, keepdims=True)
    return np.stack([np.cross(y, z), y, z], axis=-1)


def _aims(
    demonstration: Demonstration,
    followers: NDArray[np.bool_],
    settings: CandidateSettings,
    draw: np.random.Generator,
) -> tuple[Array, Array, Array]:
    """Target points, unit approaches, and sides of fingers 1 and 2 (all (n, 3))."""
    count = len(followers)
    weight = demonstration.contact / demonstration.contact.sum()
    point = draw.choice(len(weight), count, p=weight)
    aim = np.where(followers[:, None], demonstration.centre_m, demonstration.points_m[point])
    aim = aim + draw.normal(0.0, settings.position_sd_m, (count, 3))
    approach = np.where(followers[:, None], demonstration.approach, -demonstration.normals[point])
    approach = approach + draw.normal(0.0, settings.tilt_sd_rad, (count, 3))
    approach /= np.linalg.norm(approach, axis=1, keepdims=True)
    roll = draw.integers(settings.rolls, size=count) * (2 * np.pi / settings.rolls)
    near = draw.normal(0.0, settings.tilt_sd_rad, count) + np.pi * draw.integers(2, size=count)
    roll = np.where(followers, near, roll)
    # Roll zero is the person's closing direction or, without one, the least aligned axis.
    across = np.broadcast_to(demonstration.closing, (count, 3))
    parallel = np.abs(np.einsum("ni,ni->n", across, approach)) > 0.9
    least = np.eye(3)[np.abs(approach).argmin(axis=1)]
    y = frames(approach, np.where(parallel[:, None], least, across))[:, :, 1]
    side = np.cos(roll)[:, None] * y + np.sin(roll)[:, None] * np.cross(approach, y)
    return aim, approach, side
