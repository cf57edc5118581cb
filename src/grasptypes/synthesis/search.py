"""The search of one session: candidates, their energy, refinement of the best, a short list."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from grasptypes.contact_maps.contact_map import ContactMap
from grasptypes.hand import kinematics
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.object_files import read_properties
from grasptypes.synthesis.candidates import CandidateSettings, Hands, Person, draw_candidates
from grasptypes.synthesis.closing import ClosingSettings, close_fingers
from grasptypes.synthesis.energy import (
    TERMS,
    EnergySettings,
    Targets,
    closeness,
    draw_targets,
    energies,
)
from grasptypes.synthesis.equilibrium import EquilibriumSettings, imbalance
from grasptypes.synthesis.fields import Field, field
from grasptypes.synthesis.grip_shape import ShapeRanges, ShapeSettings, deviation
from grasptypes.synthesis.hand_model import FIRST_DISTAL, FIRST_PROXIMAL, HandModel

Array = NDArray[np.float64]

ALL_TERMS = (*TERMS, "imbalance", "grip_shape")


class RefinementSettings(NamedTuple):
    """A shrinking random search around the best candidates."""

    parents: int
    """How many of the best candidates are refined."""
    rounds: int
    """How often each is varied."""
    children: int
    """Variations of each in a round."""
    position_sd_m: float
    rotation_sd_rad: float
    spread_sd_rad: float
    shrink: float
    """What the deviations are multiplied with after a round."""


class RankingSettings(NamedTuple):
    """Which grasps are tried, and in which order.

    A try is a look by geometry, and a test in physics only if nothing is wrong so far: of `tries`
    grasps at most, physics may see fewer.
    """

    tries: int
    """How many grasps are looked at, at most."""
    min_fingers: int
    """Fingers that must touch."""
    contact_m: float
    """Distance up to which a link counts as touching."""
    max_depth_m: float
    """Depth, in the object or of one link in another, beyond which a candidate is not ranked."""
    apart_m: float
    """A grasp is tried only if it differs this much from all tried before it: the distance of
    the palms, plus `rotation_length_m` for every radian between them or of spread."""
    rotation_length_m: float


class SearchSettings(NamedTuple):
    """All that a search depends on beside the object and the person."""

    candidates: CandidateSettings
    closing: ClosingSettings
    energy: EnergySettings
    equilibrium: EquilibriumSettings
    grip_shape: ShapeSettings
    shapes: Mapping[str, ShapeRanges]
    """What hands keep to, by grip."""
    refinement: RefinementSettings
    ranking: RankingSettings


class Thing(NamedTuple):
    """The object as a search and the look at its grasps see it."""

    grid: Field
    centre_of_mass_m: Array
    """(3,)."""
    radius_m: float
    """Half of its largest extent."""
    surface_m: Array
    """(n, 3) points on its surface."""


def read_thing(distance_grid: str | Path, properties: str | Path, contact_map: ContactMap) -> Thing:
    """The object from its files (see `object_files`), with the points of one of its maps."""
    surface = contact_map.points.astype(np.float64)
    return Thing(
        field(DistanceGrid.load(distance_grid)),
        np.array(read_properties(properties)["centre_of_mass_m"]),
        float(np.ptp(surface, axis=0).max() / 2),
        surface,
    )


class Ranked(NamedTuple):
    """Grasps in the order of their energy, best first."""

    hands: Hands
    terms: Array
    """(n, 7) in the order of `ALL_TERMS`."""

    @property
    def energy(self) -> Array:
        """(n,) sum of the terms."""
        return self.terms.sum(axis=1)

    def take(self, index: NDArray[np.int64]) -> Ranked:
        """Those of an index."""
        return Ranked(self.hands.take(index), self.terms[index])


def search_session(
    model: HandModel, thing: Thing, person: Person, settings: SearchSettings,
    draw: np.random.Generator,
) -> Ranked:  # fmt: skip
    """The grasps of one session to be tried, at least one and at most `tries`.

    Grasps that overlap or touch with too few fingers have infinite energy and are dropped. Only
    where all candidates do are they tried, as they are, so that the session's failure has its
    reason.
    """
    targets = draw_targets(person.points_m, person.normals, person.contact, settings.energy, draw)
    shape = settings.shapes[person.grip]
    hands = draw_candidates(model, thing.grid, person, settings.candidates, settings.closing, draw)
    found = _evaluate(model, thing, hands, targets, shape, settings)
    if not np.isfinite(found.energy).any():
        found = _evaluate(model, thing, hands, targets, shape, settings, every=True)
        return found.take(_spaced(found, settings.ranking.tries, settings.ranking))
    best = found.take(_spaced(found, settings.refinement.parents, settings.ranking))
    best = refine(model, thing, best, targets, shape, settings, draw)
    return best.take(_spaced(best, settings.ranking.tries, settings.ranking))


def refine(
    model: HandModel, thing: Thing, parents: Ranked, targets: Targets, shape: ShapeRanges,
    settings: SearchSettings, draw: np.random.Generator,
) -> Ranked:  # fmt: skip
    """Vary pose and spread, close the fingers anew, and keep what has a lower energy.

    All ten degrees of freedom move, yet every grasp that is looked at touches the object, which
    steps along a gradient in the joints would not ensure.
    """
    how = settings.refinement
    scale = 1.0
    for _ in range(how.rounds):
        hands = _varied(parents.hands, how, scale, draw)
        T, spread = hands.T_object_hand, hands.joint_angles_rad[:, 0]
        closed = Hands(T, close_fingers(model, thing.grid, T, spread, settings.closing))
        children = _evaluate(model, thing, closed, targets, shape, settings)
        energy = np.column_stack([parents.energy, children.energy.reshape(-1, how.children)])
        winner = energy.argmin(axis=1)
        row = np.arange(len(winner))
        index = np.where(winner == 0, row, len(row) + row * how.children + winner - 1)
        parents = _joined(parents, children).take(index)
        scale *= how.shrink
    return parents


def _evaluate(
    model: HandModel, thing: Thing, hands: Hands, targets: Targets, shape: ShapeRanges,
    settings: SearchSettings, every: bool = False,
) -> Ranked:  # fmt: skip
    """Energies of hands (n), unless `every` counts infinite for those that must not be ranked."""
    poses = hands.T_object_hand[:, None] @ kinematics.link_poses(hands.joint_angles_rad)
    close = closeness(model, thing.grid, poses)
    touching = close.gaps_m <= settings.ranking.contact_m
    fingers = touching[:, FIRST_PROXIMAL:FIRST_DISTAL] | touching[:, FIRST_DISTAL:]
    sound = fingers.sum(axis=1) >= settings.ranking.min_fingers
    sound &= np.maximum(close.penetration_m, close.self_depth_m) <= settings.ranking.max_depth_m
    sound |= every
    terms = np.full((len(sound), len(ALL_TERMS)), np.inf)
    poses = poses[sound]
    close = type(close)(close.gaps_m[sound], close.self_depth_m[sound])
    terms[sound, : len(TERMS)] = energies(model, poses, close, targets, settings.energy)
    terms[sound, -2] = settings.equilibrium.weight * imbalance(
        model, thing.grid, poses, thing.centre_of_mass_m, thing.radius_m, settings.equilibrium
    )
    terms[sound, -1] = settings.grip_shape.weight * deviation(
        model, thing.grid, poses, hands.joint_angles_rad[sound], shape, settings.grip_shape
    )
    return Ranked(hands, terms)


def _varied(
    hands: Hands, how: RefinementSettings, scale: float, draw: np.random.Generator
) -> Hands:
    """Random neighbours (n * children) of hands (n), those of one hand in a row."""
    T = np.repeat(hands.T_object_hand, how.children, axis=0)
    angles = np.repeat(hands.joint_angles_rad, how.children, axis=0)
    shift = draw.normal(0.0, scale * how.position_sd_m, (len(T), 3))
    turn = Rotation.from_rotvec(draw.normal(0.0, scale * how.rotation_sd_rad, (len(T), 3)))
    T[:, :3, 3] += np.einsum("nij,nj->ni", T[:, :3, :3], shift)
    T[:, :3, :3] = T[:, :3, :3] @ turn.as_matrix()
    low, high = kinematics.DOF_LIMITS_RAD[0]
    spread = angles[:, :2] + draw.normal(0.0, scale * how.spread_sd_rad, len(T))[:, None]
    angles[:, :2] = np.clip(spread, low, high)
    return Hands(T, angles)


def _joined(first: Ranked, second: Ranked) -> Ranked:
    hands = [np.concatenate(pair) for pair in zip(first.hands, second.hands, strict=True)]
    return Ranked(Hands(*hands), np.concatenate([first.terms, second.terms]))


def _spaced(found: Ranked, count: int, how: RankingSettings) -> NDArray[np.int64]:
    """Indices of up to `count` grasps by energy, leaving out those too like a better one."""
    order = np.argsort(found.energy, kind="stable")
    order = order[np.isfinite(found.energy[order])]
    T, spread = found.hands.T_object_hand, found.hands.joint_angles_rad[:, 0]
    chosen: list[int] = []
    for index in order:
        if len(chosen) == count:
            break
        other = T[chosen]
        cosine = (np.einsum("nij,ij->n", other[:, :3, :3], T[index, :3, :3]) - 1.0) / 2.0
        turned = np.arccos(np.clip(cosine, -1.0, 1.0)) + np.abs(spread[chosen] - spread[index])
        apart = np.linalg.norm(other[:, :3, 3] - T[index, :3, 3], axis=1)
        if np.all(apart + how.rotation_length_m * turned >= how.apart_m):
            chosen.append(int(index))
    return np.array(chosen)
