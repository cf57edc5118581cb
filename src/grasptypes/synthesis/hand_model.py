"""The hand for batched searches: points on its links, their distance grids, and its chains."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.hand import Hand
from grasptypes.hands.links import Finger
from grasptypes.hands.surface import link_meshes, link_shapes, surface_points
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.settings.synthesis import SynthesisSettings
from grasptypes.synthesis.fields import Fields, fields

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


class Chains(NamedTuple):
    """How fingers close; F fingers with up to M closing links, L links of the hand."""

    counts: Indices
    """(F,) number of closing links."""
    links: Indices
    """(F, M) their indices, from the palm outwards."""
    prismatic: NDArray[np.bool_]
    """(F, M) whether the link's joint slides."""
    T_parent_rest: Array
    """(F, M, 4, 4) rest pose of each link in the one before it."""
    open: Array
    """(F, M) joint positions from which fingers close."""
    limits: Array
    """(F, M, 2) lowest and highest joint positions."""
    rates: Array
    """(F, M, M) row s: relative speeds after s joints have been stopped."""
    own_levers: Array
    """(F, M, M) row s: motion of a link's points per motion of joint s, for each metre of their
    distance from the link's axis."""
    base_levers: Array
    """(F, M, M) row s: the same, for points on the link's axis, metres."""


class HandModel(NamedTuple):
    """Points of all links, one link after another, and one distance grid per kind of link."""

    points: Array
    """(n, 3) on the surface of each link, in its own frame, metres."""
    starts: Indices
    """(L + 1,) start of each link's points, and the end of the last."""
    centres: Array
    """(L, 3) centre of each link's bounding sphere, in its own frame, metres."""
    radii: Array
    """(L,) radius of that sphere, metres."""
    levers: Array
    """(n,) distance of each point from its link's axis, metres."""
    grid_of_link: Indices
    """(L,) index into `grids`."""
    grids: Fields
    """Signed distances to the links' surfaces."""
    chains: Chains
    base_of_link: Indices
    """(L,) the first closing link of each closing link's finger; -1 for other links."""
    is_thumb: NDArray[np.bool_]
    """(L,) whether the link is the last one of a thumb."""
    ends_at_hand: bool
    """Whether the palm and the fingers closed before stop those that miss the object."""
    pairs: Indices
    """(P, 2) links that may collide: a closing link, and one of another finger or the base."""


@cache
def hand_model(
    hand: Hand,
    finger_spacing_m: float,
    base_spacing_m: float,
    grid_spacing_m: float,
    range_m: float,
) -> HandModel:
    """Sample a hand.

    Args:
        finger_spacing_m: distance between neighbouring points on the closing links.
        base_spacing_m: the same on the others, which are larger and touch less often.
        grid_spacing_m: distance between the nodes of the links' distance grids.
        range_m: margin of the grids around the links.
    """
    first = min(hand.finger_links)
    base, fingers = surface_points(hand, base_spacing_m), surface_points(hand, finger_spacing_m)
    of_base, of_fingers = base.link_index < first, fingers.link_index >= first
    links = np.concatenate([base.link_index[of_base], fingers.link_index[of_fingers]])
    points = np.concatenate([base.points_m[of_base], fingers.points_m[of_fingers]])
    counts = np.bincount(links, minlength=len(hand.links))
    meshes = link_meshes(hand)
    lowest = np.array([mesh.bounds[0] for mesh in meshes])
    highest = np.array([mesh.bounds[1] for mesh in meshes])
    centres = (lowest + highest) / 2
    corners = [mesh.vertices - centre for mesh, centre in zip(meshes, centres, strict=True)]
    grid_of_link, grids = _grids(hand, grid_spacing_m, range_m)
    base_of_link = np.full(len(hand.links), -1)
    for finger in hand.fingers:
        base_of_link[list(finger.links)] = finger.links[0]
    is_thumb = np.zeros(len(hand.links), dtype=bool)
    is_thumb[[finger.links[-1] for finger in hand.fingers if finger.thumb]] = True
    return HandModel(
        points=np.ascontiguousarray(points),
        starts=np.concatenate([[0], np.cumsum(counts)]),
        centres=centres,
        radii=np.array([np.linalg.norm(corner, axis=1).max() for corner in corners]),
        levers=_levers(hand, points, links),
        grid_of_link=grid_of_link,
        grids=grids,
        chains=_chains(hand),
        base_of_link=base_of_link,
        is_thumb=is_thumb,
        ends_at_hand=hand.ends_at_hand,
        pairs=_pairs(hand),
    )


class HandModels(NamedTuple):
    """The hand at two resolutions."""

    search: HandModel
    """Coarse, for thousands of candidates."""
    check: HandModel
    """Fine, for the verdict."""


def sample_hand(hand: Hand, settings: SynthesisSettings) -> HandModels:
    """A hand at the resolutions of the settings."""
    how, reach_m = settings.hand, settings.energy.range_m
    check_m, grid_m = how.check_spacing_m, how.grid_spacing_m
    return HandModels(
        hand_model(hand, how.finger_spacing_m, how.base_spacing_m, grid_m, reach_m),
        hand_model(hand, check_m, check_m, grid_m, reach_m),
    )


@cache
def _grids(hand: Hand, spacing_m: float, range_m: float) -> tuple[Indices, Fields]:
    """For each link, the index of its distance grid, and a grid of each shape."""
    meshes = link_meshes(hand)
    first, grid_of_link = np.unique(link_shapes(hand), return_inverse=True)
    grids = [
        DistanceGrid.from_mesh(
            np.asarray(meshes[link].vertices), np.asarray(meshes[link].faces), spacing_m, range_m
        )
        for link in first
    ]
    return grid_of_link.astype(np.int64), fields(grids)


def _are_parallel(hand: Hand, finger: Finger) -> bool:
    """Whether all joints of a finger turn about parallel axes."""
    axes = np.eye(3)
    for joint in finger.joints[1:]:
        axes = axes @ hand.joints[joint].T_parent_rest[:3, :3]
        if hand.joints[joint].prismatic or abs(axes[2, 2]) < 1 - 1e-9:
            return False
    return not hand.joints[finger.joints[0]].prismatic


def _levers(hand: Hand, points: Array, links: Indices) -> Array:
    """Distance of each point from its link's axis; from its origin if a finger's axes differ."""
    levers = np.sqrt(points[:, 0] ** 2 + points[:, 1] ** 2)
    for finger in hand.fingers:
        if not _are_parallel(hand, finger):
            apart = np.isin(links, finger.links)
            levers[apart] = np.linalg.norm(points[apart], axis=1)
    return levers


def _chains(hand: Hand) -> Chains:
    """The closing links of all fingers, padded to the longest one."""
    size = len(hand.fingers), max(len(finger.joints) for finger in hand.fingers)
    square = (*size, size[1])
    chains = Chains(
        counts=np.array([len(finger.joints) for finger in hand.fingers]),
        links=np.zeros(size, dtype=np.int64),
        prismatic=np.zeros(size, dtype=bool),
        T_parent_rest=np.zeros((*size, 4, 4)),
        open=np.zeros(size),
        limits=np.zeros((*size, 2)),
        rates=np.zeros(square),
        own_levers=np.zeros(square),
        base_levers=np.zeros(square),
    )
    for row, finger in enumerate(hand.fingers):
        count = len(finger.joints)
        chains.links[row, :count] = finger.links
        chains.open[row, :count] = finger.open
        chains.limits[row, :count] = hand.joint_limits[list(finger.joints)]
        chains.rates[row, :count, :count] = finger.rates
        for place, joint in enumerate(finger.joints):
            chains.prismatic[row, place] = hand.joints[joint].prismatic
            chains.T_parent_rest[row, place] = hand.joints[joint].T_parent_rest
        _set_levers(hand, finger, chains.own_levers[row], chains.base_levers[row])
    return chains


def _set_levers(hand: Hand, finger: Finger, own: Array, base: Array) -> None:
    """Bounds on the motion of a finger's points, by stage (rows) and link (columns).

    A point of link k moves by at most rate j times its distance from axis j for each joint j up to
    k: the distances between the axes in between, and its own distance from axis k.
    """
    parallel, joints = _are_parallel(hand, finger), [hand.joints[j] for j in finger.joints]
    for stage in range(len(joints)):
        for link in range(stage, len(joints)):
            for turning in range(stage, link + 1):
                rate = abs(finger.rates[stage, turning])
                if joints[turning].prismatic:
                    base[stage, link] += rate
                    continue
                own[stage, link] += rate
                for between in joints[turning + 1 : link + 1]:
                    offset = between.T_parent_rest[:3, 3]
                    length = float(np.linalg.norm(offset[:2] if parallel else offset))
                    if between.prismatic:
                        length += max(map(abs, between.limits))
                    base[stage, link] += rate * length


def _pairs(hand: Hand) -> Indices:
    """Links that may collide: not those of one finger, nor those that a joint connects."""
    of_finger = {link: finger.name for finger in hand.fingers for link in finger.links}
    connected = {(joint.parent, index + 1) for index, joint in enumerate(hand.joints)}
    pairs = [
        (link, other)
        for link in hand.finger_links
        for other in range(link)
        if of_finger.get(other) != of_finger[link]
        and (other, link) not in connected | hand.ignored_pairs
    ]
    return np.array(pairs, dtype=np.int64).reshape(-1, 2)
