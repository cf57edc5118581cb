"""Contact maps: where on an object people touch it for a task, as a population and one by one.

The paper takes them from ContactDB's thermal recordings, which are no longer to be had. Here a
virtual person chooses a hold from the affinity table and lays a hand of their own size on the
object; the population's map is the mean over as many persons as ContactDB recorded.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray

from grasptypes.contact_maps.affinities import STYLE_OF_GRIP, WHOLE, Hold
from grasptypes.contact_maps.handprint import Hand, Placement, Surface, handprint
from grasptypes.contact_maps.placement import place_hand
from grasptypes.errors import InputError
from grasptypes.seeds import rng, seed

# Within about 70 degrees of the closing direction, a surface resists the digit that presses on it.
OPPOSED_COSINE = 0.35
GOLDEN_RATIO = (5**0.5 - 1) / 2


@dataclass(frozen=True)
class ContactMap:
    """Contact maps of one object and task, in the object's frame and in metres.

    Attributes:
        points: (N, 3) float32, evenly spread over the surface.
        normals: (N, 3) float32, outward.
        part_index: (N,) int16 into `part_names`.
        part_names: (P,) str.
        probability: (N,) float32, share of people who touch the point; 0 where unknown.
        sessions: (S, N) float32, one person's contact each, 0 to 1.
        style: (S,) str, power or precision.
        grip: (S,) str, a grip of the affinity table.
        part: (S,) str, the held parts, joined by `+`.
        approach: (S, 3) float32, unit direction in which the palm moves onto the object.
        closing: (S, 3) float32, unit direction from the thumb to the fingers.
        centre_m: (S, 3) float32, between palm, fingers and thumb.
        height: (S,) float32, 0 to 1 along the held parts, or along what a measured map shows.
        hand_length_m: (S,) float32, of a hand as large as the object's scale makes it.
    """

    points: NDArray[np.float32]
    normals: NDArray[np.float32]
    part_index: NDArray[np.int16]
    part_names: NDArray[np.str_]
    probability: NDArray[np.float32]
    sessions: NDArray[np.float32]
    style: NDArray[np.str_]
    grip: NDArray[np.str_]
    part: NDArray[np.str_]
    approach: NDArray[np.float32]
    closing: NDArray[np.float32]
    centre_m: NDArray[np.float32]
    height: NDArray[np.float32]
    hand_length_m: NDArray[np.float32]


@dataclass(frozen=True)
class Points:
    """Points (N, 3) m on an object's surface, their normals (N, 3) and part indices (N,)."""

    points_m: NDArray[np.float64]
    normals: NDArray[np.float64]
    part_index: NDArray[np.int16]


@dataclass(frozen=True)
class Session:
    """One person's way of holding: the hold, the placed hand, its size, and its contact (N,)."""

    hold: Hold
    placement: Placement
    height: float
    hand: Hand
    contact: NDArray[np.float64]


def sample_surface(
    vertices: ArrayLike, faces: ArrayLike, part_index: ArrayLike, count: int, seed_number: int
) -> Points:
    """At most `count` points spread evenly over a mesh.

    Args:
        vertices: (V, 3) metres.
        faces: (F, 3) indices.
        part_index: (V,) part of each vertex; a face belongs to the part of its first vertex.
    """
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    points_m, face = trimesh.sample.sample_surface_even(mesh, count, seed=seed_number)
    parts = np.asarray(part_index)[np.asarray(faces)[face, 0]]
    return Points(np.asarray(points_m), mesh.face_normals[face], parts.astype(np.int16))


def draw_hand(draw: np.random.Generator, params: Mapping[str, Any], scale: float) -> Hand:
    """A person's hand, grown with the object's scale as ContactGrasp's contact maps are.

    Args:
        params: the `contact_maps` section of params.yaml.
    """
    group = params["people"][int(draw.integers(len(params["people"])))]
    length_m = draw.normal(group["hand_length_m"], group["hand_length_sd_m"])
    return Hand.of_length(scale * length_m, params["hand"])


def draw_session(
    points: Points,
    part_names: Sequence[str],
    holds: Sequence[Hold],
    key: tuple[str, str, int, int],
    params: Mapping[str, Any],
    scale: float,
) -> Session:
    """One person's way of holding an object.

    A person whose thumb and fingers do not end up on two sides of the object tries again.

    Args:
        key: object, task, session and seed: all that the draw depends on beside the parameters.
        params: the `contact_maps` section of params.yaml.
        scale: the object's.

    Raises:
        InputError: nobody can hold the object as the drawn row of the affinity table says.
    """
    draw = rng("contact_map", *key)
    hold = _choose(holds, key)
    mask = np.isin(points.part_index, [part_names.index(part) for part in hold.parts])
    if not hold.parts:
        mask[:] = True
    surface = Surface(points.points_m, points.normals, mask)
    hand = draw_hand(draw, params, scale)
    for _ in range(params["tries"]):
        placement, height = place_hand(surface, hold, hand, params["placement"], draw)
        contact = handprint(surface, hold.grip, placement, hand)
        if opposes(points.normals[contact >= params["threshold"]], placement.closing):
            return Session(hold, placement, height, hand, contact)
    raise InputError(
        params["affinities"],
        f"{key[0]}, {key[1]}, {'+'.join(hold.parts) or WHOLE}, {hold.grip} {hold.approach}",
        f"{params['tries']} people could not hold it this way: "
        "thumb and fingers found no opposing sides",
    )


def map_contacts(
    points: Points,
    part_names: Sequence[str],
    holds: Sequence[Hold],
    name: tuple[str, str],
    seed_number: int,
    params: Mapping[str, Any],
    scale: float,
) -> ContactMap:
    """The population's map of an object and task, and the maps of its first people, the sessions.

    Args:
        name: object and task.
        params: the `contact_maps` section of params.yaml.
    """
    count = max(params["sessions"], params["population"])
    people = [
        draw_session(points, part_names, holds, (*name, number, seed_number), params, scale)
        for number in range(1, count + 1)
    ]
    probability = np.mean([person.contact for person in people], axis=0)
    return of_sessions(points, part_names, probability, people[: params["sessions"]])


def of_sessions(
    points: Points,
    part_names: Sequence[str],
    probability: NDArray[np.float64],
    shown: Sequence[Session],
) -> ContactMap:
    """The contact map of a population's probability (N,) and the sessions drawn for it."""
    grips = [person.hold.grip for person in shown]
    return ContactMap(
        points=points.points_m.astype(np.float32),
        normals=points.normals.astype(np.float32),
        part_index=points.part_index,
        part_names=np.array(part_names, dtype=np.str_),
        probability=_single(probability),
        sessions=_single([person.contact for person in shown]),
        style=np.array([STYLE_OF_GRIP[grip] for grip in grips]),
        grip=np.array(grips),
        part=np.array(["+".join(person.hold.parts) or WHOLE for person in shown]),
        approach=_single([-person.placement.palm_side for person in shown]),
        closing=_single([person.placement.closing for person in shown]),
        centre_m=_single([person.placement.centre_m for person in shown]),
        height=_single([person.height for person in shown]),
        hand_length_m=_single([person.hand.length_m for person in shown]),
    )


def _single(values: ArrayLike) -> NDArray[np.float32]:
    return np.asarray(values, dtype=np.float32)


def opposes(normals: NDArray[np.float64], closing: NDArray[np.float64]) -> bool:
    """Whether touched normals (K, 3) face both ways along the closing direction."""
    facing = normals @ closing
    return bool((facing > OPPOSED_COSINE).any() and (facing < -OPPOSED_COSINE).any())


def _choose(holds: Sequence[Hold], key: tuple[str, str, int, int]) -> Hold:
    """A hold by affinity: over any run of sessions each comes up in proportion to its affinity.

    Steps of the golden ratio leave no long gaps, so 20 sessions show the table's shares better
    than 20 independent draws would, and session 7 stays the same if there are 30.
    """
    object_name, task, session, seed_number = key
    start = seed("holds", object_name, task, seed_number) / 2**63
    quantile = (start + session * GOLDEN_RATIO) % 1.0
    shares = np.cumsum([hold.affinity for hold in holds])
    return holds[int(np.searchsorted(shares, quantile * shares[-1], side="right"))]
