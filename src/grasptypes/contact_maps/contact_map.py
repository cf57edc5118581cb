"""Contact maps: where people touch an object for a task, as a population and individually.

The paper takes them from ContactDB's thermal recordings, which are no longer available. Here a
virtual person chooses a hold (see `holds`) and places a hand of their own size on the
object; the population's map is the mean over as many people as ContactDB recorded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import trimesh
from numpy.typing import ArrayLike, NDArray

from grasptypes.contact_maps.handprint import handprint
from grasptypes.contact_maps.hold import STYLE_OF_GRIP, Hold
from grasptypes.contact_maps.placement import (
    HeldSurface,
    HumanHand,
    Placement,
    SurfacePoints,
    place_hand,
)
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
        grip: (S,) str, a grip of `hold.STYLE_OF_GRIP`.
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
class Session:
    """One person's way of holding: the placed hand, its size, and its contact (N,)."""

    hold: Hold
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

    points: SurfacePoints
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

    def surface(self, parts: Sequence[str]) -> HeldSurface:
        """The object's surface with some parts marked; all of it if none are named."""
        points = self.points
        wanted = [self.part_names.index(part) for part in parts or self.part_names]
        return HeldSurface(points.points_m, points.normals, np.isin(points.part_index, wanted))

    def typical_hand(self) -> HumanHand:
        """The hand of mean length."""
        lengths_m = [group.hand_length_m for group in self.settings.people]
        return HumanHand.of_length(self.scale * float(np.mean(lengths_m)), self.settings.hand)

    def draw_hand(self, draw: np.random.Generator) -> HumanHand:
        """A person's hand."""
        people = self.settings.people
        group = people[int(draw.integers(len(people)))]
        length_m = draw.normal(group.hand_length_m, group.hand_length_sd_m)
        return HumanHand.of_length(self.scale * length_m, self.settings.hand)

    def try_hold(
        self,
        held: HeldSurface,
        hold: Hold,
        hand: HumanHand,
        draw: np.random.Generator,
        reached: HeldSurface | None = None,
    ) -> Session | None:
        """Place a hand once; None if thumb and fingers do not touch opposing sides of the object.

        Args:
            held: where the hand is put.
            reached: where it may touch; default: the same.
        """
        placement, height = place_hand(held, hold, hand, self.settings.placement, draw)
        contact = handprint(reached or held, hold.grip, placement, hand)
        facing = self.points.normals[contact >= self.settings.threshold] @ placement.closing
        if not ((facing > OPPOSED_COSINE).any() and (facing < -OPPOSED_COSINE).any()):
            return None
        return Session(hold, placement, height, hand, contact)


def sample_surface(mesh: Surface, count: int, seed_number: int) -> SurfacePoints:
    """At most `count` evenly spread points; a face has the part of its first vertex."""
    shape = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    points_m, face = trimesh.sample.sample_surface_even(shape, count, seed=seed_number % 2**31)
    parts = np.asarray(mesh.part_index)[np.asarray(mesh.faces)[face, 0]]
    return SurfacePoints(np.asarray(points_m), shape.face_normals[face], parts.astype(np.int16))


def draw_session(task: MapTask, holds: Sequence[Hold], number: int) -> Session:
    """One person's way of holding an object: one of the holds, by their probability.

    If thumb and fingers do not end up on opposing sides of the object, the person tries again, and
    then chooses one of the other holds.

    Raises:
        InputError: the object cannot be held in any of these ways.
    """
    key = task.key(number)
    draw = rng("contact_map", *key)
    hand = task.draw_hand(draw)
    chosen, left = _choose(holds, key), list(holds)
    while True:
        held, reached = task.surface(chosen.parts), task.surface(chosen.touchable)
        for _ in range(task.settings.tries):
            if session := task.try_hold(held, chosen, hand, draw, reached):
                return session
        left.remove(chosen)
        if not left:
            ways = ", ".join(f"{hold.grip} {hold.part}" for hold in holds)
            said = f"nobody can hold it: in {task.settings.tries} placements of each hold thumb "
            raise InputError(
                " and ".join(task.name), "", f"{said}and fingers found no opposing sides ({ways})"
            )
        shares = np.cumsum([hold.probability for hold in left])
        chosen = left[int(np.searchsorted(shares, draw.uniform(0.0, shares[-1]), side="right"))]


def map_contacts(task: MapTask, holds: Sequence[Hold]) -> ContactMap:
    """The population's map of an object and task, and the maps of its first people (the sessions).

    Args:
        holds: of this object and task, see `holds.find_holds`.
    """
    count = max(task.settings.sessions, task.settings.population)
    people = [draw_session(task, holds, number) for number in range(1, count + 1)]
    probability = np.mean([person.contact for person in people], axis=0)
    return of_sessions(task, probability, people[: task.settings.sessions])


def of_sessions(
    task: MapTask, probability: NDArray[np.float64], shown: Sequence[Session]
) -> ContactMap:
    """Contact map from a population's probability (N,) and the sessions drawn for it."""
    points, grips = task.points, [person.hold.grip for person in shown]
    return ContactMap(
        points=points.points_m.astype(np.float32),
        normals=points.normals.astype(np.float32),
        part_index=points.part_index,
        part_names=np.array(task.part_names, dtype=np.str_),
        probability=_single(probability),
        sessions=_single([person.contact for person in shown]),
        style=np.array([STYLE_OF_GRIP[grip] for grip in grips]),
        grip=np.array(grips),
        part=np.array([person.hold.part for person in shown]),
        approach=_single([-person.placement.palm_side for person in shown]),
        closing=_single([person.placement.closing for person in shown]),
        centre_m=_single([person.placement.centre_m for person in shown]),
        height=_single([person.height for person in shown]),
        hand_length_m=_single([person.hand.length_m for person in shown]),
    )


def _single(values: ArrayLike) -> NDArray[np.float32]:
    return np.asarray(values, dtype=np.float32)


def _choose(holds: Sequence[Hold], key: tuple[str, str, int, int]) -> Hold:
    """Choose a hold so that over the sessions each occurs in proportion to its probability.

    With steps of the golden ratio, 20 sessions match the probabilities better than 20 independent
    draws, and session 7 stays the same if there are 30.
    """
    object_name, task, session, seed_number = key
    start = seed("holds", object_name, task, seed_number) / 2**63
    quantile = (start + session * GOLDEN_RATIO) % 1.0
    shares = np.cumsum([hold.probability for hold in holds])
    return holds[int(np.searchsorted(shares, quantile * shares[-1], side="right"))]
