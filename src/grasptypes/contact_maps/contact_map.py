"""Contact maps: where people touch an object for a task, as a population and individually.

The paper takes them from ContactDB's thermal recordings, which are no longer available. Here a
virtual person chooses a hold from the affinity table and places a hand of their own size on the
object; the population's map is the mean over as many people as ContactDB recorded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray

from grasptypes.contact_maps.affinities import STYLE_OF_GRIP, WHOLE, AffinityRow
from grasptypes.contact_maps.handprint import handprint
from grasptypes.contact_maps.placement import HeldSurface, HumanHand, Placement, place_hand
from grasptypes.errors import InputError
from grasptypes.objects.object_files import Surface
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.seeds import rng, seed
from grasptypes.settings.contact_maps import ContactMapSettings

# Within about 70 degrees of the closing direction, a surface resists the digit that presses on it.
OPPOSED_COSINE = 0.35
GOLDEN_RATIO = (5**0.5 - 1) / 2
# Fields of a contact map with one row per session, apart from the contacts themselves.
BY_SESSION = ("style", "grip", "part", "approach", "closing", "centre_m", "height", "hand_length_m")


@dataclass(frozen=True)
class ContactMap:
    """Contact maps of one object and task, in the object's frame and in metres.

    Attributes:
        points: (N, 3) float32, evenly spread over the surface.
        normals: (N, 3) float32, outward.
        part_index: (N,) int16 into `part_names`.
        part_names: (P,) str.
        probability: (N,) float32, share of people who touch the point; 0 if unknown.
        sessions: (S, N) float32, contact of one person each, 0 to 1.
        style: (S,) str, power or precision.
        grip: (S,) str, a grip of the affinity table.
        part: (S,) str, the held parts, joined by `+`.
        approach: (S, 3) float32, unit direction in which the palm moves onto the object.
        closing: (S, 3) float32, unit direction from the thumb to the fingers.
        centre_m: (S, 3) float32, between palm, fingers and thumb.
        height: (S,) float32, 0 to 1 along the held parts, or along the region of a measured map.
        hand_length_m: (S,) float32, scaled with the object.
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

    def session(self, index: int) -> ContactMap:
        """The map with only one of its sessions."""
        row, names = slice(index, index + 1), (*BY_SESSION, "sessions")
        return replace(self, **{name: getattr(self, name)[row] for name in names})


@dataclass(frozen=True)
class Points:
    """Points (N, 3) m on an object's surface, their normals (N, 3) and part indices (N,)."""

    points_m: NDArray[np.float64]
    normals: NDArray[np.float64]
    part_index: NDArray[np.int16]


@dataclass(frozen=True)
class Session:
    """One person's way of holding: the row, the placed hand, its size, and its contact (N,)."""

    row: AffinityRow
    placement: Placement
    height: float
    hand: HumanHand
    contact: NDArray[np.float64]


@dataclass(frozen=True)
class MapTask:
    """Input of the contact maps of one object and task.

    Attributes:
        points: points on the object.
        part_names: parts of the object.
        name: object and task, part of the key of every draw.
        seed: also part of that key.
        scale: scale of the object and of the hands, as in ContactGrasp's contact maps.
    """

    points: Points
    part_names: Sequence[str]
    name: tuple[str, str]
    seed: int
    scale: float
    settings: ContactMapSettings

    @classmethod
    def of_object(
        cls,
        geometry: ObjectGeometry,
        name: tuple[str, str],
        seed_number: int,
        settings: ContactMapSettings,
    ) -> MapTask:
        """The task for a prepared object."""
        mesh = geometry.surface
        points = sample_surface(mesh, settings.points, seed("surface", name[0], seed_number))
        names = [str(part) for part in mesh.part_names]
        return cls(points, names, name, seed_number, geometry.properties.scale, settings)

    def key(self, session: int) -> tuple[str, str, int, int]:
        """Key of a session's random draws, which depend on nothing else but the settings."""
        return (*self.name, session, self.seed)

    def draw_hand(self, draw: np.random.Generator) -> HumanHand:
        """A person's hand."""
        people = self.settings.people
        group = people[int(draw.integers(len(people)))]
        length_m = draw.normal(group.hand_length_m, group.hand_length_sd_m)
        return HumanHand.of_length(self.scale * length_m, self.settings.hand)

    def try_hold(
        self,
        held: HeldSurface,
        row: AffinityRow,
        hand: HumanHand,
        draw: np.random.Generator,
        reached: HeldSurface | None = None,
    ) -> Session | None:
        """Place a hand once; None if thumb and fingers do not touch opposing sides of the object.

        Args:
            held: where the hand is put.
            reached: where it may touch; default: the same.
        """
        placement, height = place_hand(held, row, hand, self.settings.placement, draw)
        contact = handprint(reached or held, row.grip, placement, hand)
        facing = self.points.normals[contact >= self.settings.threshold] @ placement.closing
        if not ((facing > OPPOSED_COSINE).any() and (facing < -OPPOSED_COSINE).any()):
            return None
        return Session(row, placement, height, hand, contact)


def sample_surface(mesh: Surface, count: int, seed_number: int) -> Points:
    """At most `count` evenly spread points; a face has the part of its first vertex."""
    shape = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    points_m, face = trimesh.sample.sample_surface_even(shape, count, seed=seed_number % 2**31)
    parts = np.asarray(mesh.part_index)[np.asarray(mesh.faces)[face, 0]]
    return Points(np.asarray(points_m), shape.face_normals[face], parts.astype(np.int16))


def draw_session(task: MapTask, rows: Sequence[AffinityRow], number: int) -> Session:
    """One person's way of holding an object, as one of the rows of the affinity table says.

    If thumb and fingers do not end up on opposing sides of the object, the person tries again.

    Raises:
        InputError: the object cannot be held as the drawn row says.
    """
    points, settings, key = task.points, task.settings, task.key(number)
    draw = rng("contact_map", *key)
    row = _choose(rows, key)
    mask = np.isin(points.part_index, [task.part_names.index(part) for part in row.parts])
    if not row.parts:
        mask[:] = True
    surface = HeldSurface(points.points_m, points.normals, mask)
    hand = task.draw_hand(draw)
    for _ in range(settings.tries):
        if session := task.try_hold(surface, row, hand, draw):
            return session
    raise InputError(
        settings.affinities,
        f"{key[0]}, {key[1]}, {'+'.join(row.parts) or WHOLE}, {row.grip} {row.approach}",
        f"{settings.tries} people could not hold it this way: thumb and fingers found no opposing "
        "sides",
    )


def map_contacts(task: MapTask, rows: Sequence[AffinityRow]) -> ContactMap:
    """The population's map of an object and task, and the maps of its first people (the sessions).

    Args:
        rows: of the affinity table, for this object and task.
    """
    count = max(task.settings.sessions, task.settings.population)
    people = [draw_session(task, rows, number) for number in range(1, count + 1)]
    probability = np.mean([person.contact for person in people], axis=0)
    return of_sessions(task, probability, people[: task.settings.sessions])


def of_sessions(
    task: MapTask, probability: NDArray[np.float64], shown: Sequence[Session]
) -> ContactMap:
    """Contact map from a population's probability (N,) and the sessions drawn for it."""
    points, grips = task.points, [person.row.grip for person in shown]
    return ContactMap(
        points=points.points_m.astype(np.float32),
        normals=points.normals.astype(np.float32),
        part_index=points.part_index,
        part_names=np.array(task.part_names, dtype=np.str_),
        probability=_single(probability),
        sessions=_single([person.contact for person in shown]),
        style=np.array([STYLE_OF_GRIP[grip] for grip in grips]),
        grip=np.array(grips),
        part=np.array(["+".join(person.row.parts) or WHOLE for person in shown]),
        approach=_single([-person.placement.palm_side for person in shown]),
        closing=_single([person.placement.closing for person in shown]),
        centre_m=_single([person.placement.centre_m for person in shown]),
        height=_single([person.height for person in shown]),
        hand_length_m=_single([person.hand.length_m for person in shown]),
    )


def _single(values: ArrayLike) -> NDArray[np.float32]:
    return np.asarray(values, dtype=np.float32)


def _choose(rows: Sequence[AffinityRow], key: tuple[str, str, int, int]) -> AffinityRow:
    """Choose a row so that over the sessions each occurs in proportion to its affinity.

    With steps of the golden ratio, 20 sessions match the table's shares better than 20 independent
    draws, and session 7 stays the same if there are 30.
    """
    object_name, task, session, seed_number = key
    start = seed("holds", object_name, task, seed_number) / 2**63
    quantile = (start + session * GOLDEN_RATIO) % 1.0
    shares = np.cumsum([row.affinity for row in rows])
    return rows[int(np.searchsorted(shares, quantile * shares[-1], side="right"))]
