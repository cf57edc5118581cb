"""Grasp wrench space: how large a wrench the contacts can resist in every direction.

The contacts' forces are limited by the torques of the joints behind them. The space is the convex
hull of the wrenches of single contacts, each at its limit, along the edges of its friction cone.
Epsilon is the radius of the largest ball around the origin in it, 0 without force closure; volume
is that of the hull. (C. Ferrari and J. Canny, Planning optimal grasps, ICRA 1992.)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from grasptypes.hands.hand import PALM, Hand
from grasptypes.physics.engine import Contact

Array = NDArray[np.float64]

# The contacts of a link that are kept: the strongest one and those farthest from it and each other.
CONTACTS_OF_LINK = 3
# Lever below which a joint does not feel a force: a tenth of a millimetre.
FELT_M = 1e-4


class WrenchSpace(NamedTuple):
    """Size of a grasp wrench space; torques per the object's radius, so that all is in newtons."""

    epsilon_n: float
    volume_n6: float


class Body(NamedTuple):
    """What wrenches on an object are measured by."""

    centre_m: Array
    """(3,) centre of mass, in the object's frame."""
    radius_m: float
    """Half of its largest extent."""


def wrench_space(
    contacts: Sequence[Contact],
    T_object_link: Array,
    hand: Hand,
    torques: Array,
    body: Body,
    friction: float,
    edges: int,
) -> WrenchSpace:
    """The wrench space of a grasp.

    Args:
        T_object_link: (L, 4, 4) the links as held.
        torques: (J,) largest torque of each joint, N m, or force, N; 0 for joints that follow.
        edges: edges of a friction pyramid.
    """
    wrenches = [
        limit * wrench
        for contact in _spread(contacts)
        if (limit := _limit(contact, T_object_link, hand, torques)) > 0.0
        for wrench in _cone(contact, body, friction, edges)
    ]
    if len(wrenches) < 7:
        return WrenchSpace(0.0, 0.0)
    try:
        hull = ConvexHull(np.array(wrenches))
    except QhullError:  # all wrenches in one plane: no force closure
        return WrenchSpace(0.0, 0.0)
    return WrenchSpace(max(0.0, float(-hull.equations[:, -1].max())), float(hull.volume))


def _spread(contacts: Sequence[Contact]) -> list[Contact]:
    """At most `CONTACTS_OF_LINK` contacts of each link, far from each other."""
    kept: list[Contact] = []
    for link in sorted({contact.link for contact in contacts}):
        left = [contact for contact in contacts if contact.link == link]
        chosen = [max(left, key=lambda contact: contact.force_n)]
        points = np.array([contact.point_m for contact in left])
        while len(chosen) < min(CONTACTS_OF_LINK, len(left)):
            others = np.array([contact.point_m for contact in chosen])
            gaps = np.linalg.norm(points[:, None] - others, axis=2).min(axis=1)
            chosen.append(left[int(gaps.argmax())])
        kept += chosen
    return kept


def _limit(contact: Contact, T_object_link: Array, hand: Hand, torques: Array) -> float:
    """The largest normal force that the joints behind a contact can bear, N.

    The palm, and links whose joints do not feel the force, bear what the fingers press against
    them: as much as the strongest fingertip can.
    """
    most = max(_tip_limit(hand, T_object_link, torques, link) for link in hand.tip_links)
    own = _bearable(hand, T_object_link, torques, contact.link, contact.point_m, contact.normal)
    return min(most, own)


def _tip_limit(hand: Hand, T_object_link: Array, torques: Array, tip: int) -> float:
    finger = next(finger for finger in hand.fingers if finger.links[-1] == tip)
    pose = T_object_link[tip]
    point = pose[:3, :3] @ finger.tip_m + pose[:3, 3]
    axis, origin = T_object_link[tip, :3, 2], T_object_link[tip, :3, 3]
    way = axis if hand.joints[tip - 1].prismatic else np.cross(axis, point - origin)
    return _bearable(hand, T_object_link, torques, tip, point, way / np.linalg.norm(way))


def _bearable(
    hand: Hand, T_object_link: Array, torques: Array, link: int, point: Array, normal: Array
) -> float:
    """The largest force along a normal at a point of a link, in the object's frame."""
    limit = float("inf")
    while link != PALM:
        axis, origin = T_object_link[link, :3, 2], T_object_link[link, :3, 3]
        joint = hand.joints[link - 1]
        way = axis if joint.prismatic else np.cross(axis, point - origin)
        share = abs(float(way @ normal))
        if share > FELT_M and torques[link - 1] > 0.0:
            limit = min(limit, float(torques[link - 1]) / share)
        link = joint.parent
    return limit


def _cone(contact: Contact, body: Body, friction: float, edges: int) -> Array:
    """(edges, 6) wrenches along the edges of a contact's friction cone, 1 N along its normal."""
    normal = contact.normal / np.linalg.norm(contact.normal)
    first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first /= np.linalg.norm(first)
    angles = 2.0 * np.pi * np.arange(edges) / edges
    sideways = np.outer(np.cos(angles), first) + np.outer(np.sin(angles), np.cross(normal, first))
    forces = normal + friction * sideways
    arm = (contact.point_m - body.centre_m) / body.radius_m
    return np.concatenate([forces, np.cross(arm, forces)], axis=1)
