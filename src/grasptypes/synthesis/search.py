"""The search of one session: candidates, energy, refinement of the best, a short list."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from grasptypes.hands.description import ShapeRanges
from grasptypes.hands.states import HandStates
from grasptypes.settings.synthesis import RankingSettings, RefinementSettings, SynthesisSettings
from grasptypes.synthesis.candidates import Demonstration, draw_candidates
from grasptypes.synthesis.closing import close_fingers
from grasptypes.synthesis.energy import (
    TERMS,
    Closeness,
    Targets,
    closeness,
    draw_targets,
    energies,
)
from grasptypes.synthesis.equilibrium import wrench_residual
from grasptypes.synthesis.preshape_cost import preshape_cost
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]

ALL_TERMS = (*TERMS, "imbalance", "grip_shape")


class RankedGrasps(NamedTuple):
    """Grasps in order of energy, best first."""

    hands: HandStates
    terms: Array
    """(n, 7) in the order of `ALL_TERMS`."""

    @property
    def energy(self) -> Array:
        """(n,) sum of the terms."""
        return np.asarray(self.terms.sum(axis=1))

    def take(self, index: NDArray[np.int64]) -> RankedGrasps:
        """The grasps of an index."""
        return RankedGrasps(self.hands.take(index), self.terms[index])


class CostFunction(NamedTuple):
    """Cost of hands that should hold the object of a scene as a demonstration shows."""

    scene: GraspScene
    targets: Targets
    ranges: ShapeRanges
    settings: SynthesisSettings

    def evaluate(self, hands: HandStates, every: bool = False) -> RankedGrasps:
        """Energies of hands (n); infinite for those that must not be ranked, unless `every` is set.

        A grasp must not be ranked if it penetrates or touches with too few fingers.
        """
        scene, settings = self.scene, self.settings
        poses = hands.link_poses()
        close = closeness(scene, poses)
        touching = close.gaps_m <= settings.ranking.contact_m
        fingers = [touching[:, finger.links].any(axis=1) for finger in scene.hand.fingers]
        sound = np.sum(fingers, axis=0) >= settings.ranking.min_fingers
        depth = np.maximum(close.penetration_m, close.self_depth_m)
        sound &= depth <= settings.ranking.max_depth_m
        sound |= every
        terms = np.full((len(sound), len(ALL_TERMS)), np.inf)
        poses, positions = poses[sound], hands.joint_positions[sound]
        close = Closeness(close.gaps_m[sound], close.self_depth_m[sound])
        terms[sound, : len(TERMS)] = energies(
            scene.model, poses, close, self.targets, settings.energy
        )
        residual = wrench_residual(scene, poses, settings.equilibrium)
        terms[sound, -2] = settings.equilibrium.weight * residual
        cost = preshape_cost(scene, poses, positions, self.ranges, settings.grip_shape)
        terms[sound, -1] = settings.grip_shape.weight * cost
        return RankedGrasps(hands, terms)


def search_session(
    scene: GraspScene,
    demonstration: Demonstration,
    settings: SynthesisSettings,
    draw: np.random.Generator,
) -> RankedGrasps:
    """The grasps of one session to try, at least one and at most `tries`.

    Grasps that must not be ranked are dropped, unless that applies to all candidates: then they are
    tried anyway, so that the session's failure has a reason.
    """
    targets = draw_targets(demonstration, settings.energy, draw)
    ranges = scene.hand.grips.named(demonstration.grip).shape
    cost = CostFunction(scene, targets, ranges, settings)
    hands = draw_candidates(scene, demonstration, settings.candidates, settings.closing, draw)
    found = cost.evaluate(hands)
    if not np.isfinite(found.energy).any():
        found = cost.evaluate(hands, every=True)
        return found.take(_spaced(found, settings.ranking.tries, settings.ranking))
    best = found.take(_spaced(found, settings.refinement.parents, settings.ranking))
    best = refine(cost, best, draw)
    return best.take(_spaced(best, settings.ranking.tries, settings.ranking))


def refine(cost: CostFunction, parents: RankedGrasps, draw: np.random.Generator) -> RankedGrasps:
    """Vary pose and preshape, close the fingers again, and keep grasps of lower energy.

    All degrees of freedom vary, and yet every grasp touches the object, which gradient steps in
    joint space would not ensure.
    """
    how, closing = cost.settings.refinement, cost.settings.closing
    scale = 1.0
    for _ in range(how.rounds):
        T_object_hand, preshape = _varied(parents.hands, how, scale, draw)
        children = cost.evaluate(close_fingers(cost.scene, T_object_hand, preshape, closing))
        energy = np.column_stack([parents.energy, children.energy.reshape(-1, how.children)])
        winner = energy.argmin(axis=1)
        row = np.arange(len(winner))
        index = np.where(winner == 0, row, len(row) + row * how.children + winner - 1)
        parents = _joined(parents, children).take(index)
        scale *= how.shrink
    return parents


def _varied(
    hands: HandStates, how: RefinementSettings, scale: float, draw: np.random.Generator
) -> tuple[Array, Array]:
    """Random neighbours of hands (n): poses (n * children, 4, 4) and preshapes (n * children, P).

    Those of one hand are consecutive.
    """
    T = np.repeat(hands.T_object_hand, how.children, axis=0)
    preshape = np.repeat(hands.preshape, how.children, axis=0)
    shift = draw.normal(0.0, scale * how.position_sd_m, (len(T), 3))
    turn = Rotation.from_rotvec(draw.normal(0.0, scale * how.rotation_sd_rad, (len(T), 3)))
    T[:, :3, 3] += np.einsum("nij,nj->ni", T[:, :3, :3], shift)
    T[:, :3, :3] = T[:, :3, :3] @ turn.as_matrix()
    low, high = hands.hand.dof_limits[: preshape.shape[1]].T
    preshape = preshape + draw.normal(0.0, scale * how.preshape_sd_rad, preshape.shape)
    return T, np.clip(preshape, low, high)


def _joined(first: RankedGrasps, second: RankedGrasps) -> RankedGrasps:
    hands = [np.concatenate(pair) for pair in zip(first.hands[1:], second.hands[1:], strict=True)]
    return RankedGrasps(
        HandStates(first.hands.hand, *hands), np.concatenate([first.terms, second.terms])
    )


def _spaced(found: RankedGrasps, count: int, how: RankingSettings) -> NDArray[np.int64]:
    """Indices of up to `count` grasps by energy, without those too similar to a better one."""
    order = np.argsort(found.energy, kind="stable")
    order = order[np.isfinite(found.energy[order])]
    T, preshape = found.hands.T_object_hand, found.hands.preshape
    chosen: list[int] = []
    for index in order:
        if len(chosen) == count:
            break
        other = T[chosen]
        cosine = (np.einsum("nij,ij->n", other[:, :3, :3], T[index, :3, :3]) - 1.0) / 2.0
        turned = np.arccos(np.clip(cosine, -1.0, 1.0))
        turned += np.abs(preshape[chosen] - preshape[index]).sum(axis=1)
        apart = np.linalg.norm(other[:, :3, 3] - T[index, :3, 3], axis=1)
        if np.all(apart + how.rotation_length_m * turned >= how.apart_m):
            chosen.append(int(index))
    return np.array(chosen)
