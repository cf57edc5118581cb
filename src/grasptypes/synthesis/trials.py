"""The grasp of a session: candidates are tested in physics by rank until one is valid and still has
the shape of the person's grip. If there is none, the valid one with the smallest deviation is
taken. A session without a valid grasp searches again.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_map import ContactMap
from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.physics.engines import engine
from grasptypes.physics.holding import hold
from grasptypes.physics.loads import TaskLoad
from grasptypes.seeds import rng, seed
from grasptypes.settings.physics import GraspTestSettings, ValiditySettings
from grasptypes.settings.synthesis import SynthesisSettings
from grasptypes.synthesis.candidates import Demonstration, pregrasp
from grasptypes.synthesis.grasps import ENERGY_TERMS
from grasptypes.synthesis.hand_model import sample_hand
from grasptypes.synthesis.preshape_cost import preshape_cost
from grasptypes.synthesis.scene import GraspScene, grasp_scene
from grasptypes.synthesis.search import RankedGrasps, search_session
from grasptypes.synthesis.tester import GraspTester, GraspTrial

Array = NDArray[np.float64]

LOGGER = logging.getLogger("grasptypes")


class SynthesisTask(NamedTuple):
    """The sessions of one object and task."""

    object_name: str
    task: str
    geometry: ObjectGeometry
    contact_map: ContactMap
    seed: int
    load: TaskLoad | None = None
    """What the task puts on the object besides its weight."""


def synthesize(
    task: SynthesisTask, hand: Hand, settings: SynthesisSettings, test: GraspTestSettings
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """One grasp per session.

    Returns:
        Tables that meet `grasps.grasp_schema` and `grasps.attempt_schema`.
    """
    surface_m, models = task.contact_map.points.astype(np.float64), sample_hand(hand, settings)
    search = grasp_scene(hand, models.search, task.geometry, surface_m)
    check = search._replace(model=models.check)
    with ExitStack() as stack:
        worlds = [
            stack.enter_context(engine(name, hand, task.geometry, test.test))
            for name in test.test.engines
        ]
        first, *others = worlds
        tester = GraspTester(
            check,
            partial(hold, first, load=task.load),
            test.validity,
            [partial(hold, other) for other in others],
        )
        return synthesize_sessions(task, search, tester, settings)


def synthesize_sessions(
    task: SynthesisTask, scene: GraspScene, tester: GraspTester, settings: SynthesisSettings
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Like `synthesize`, with a given scene (with the coarse hand) and tester."""
    grasps: list[Mapping[str, Any]] = []
    attempts: list[Mapping[str, Any]] = []
    for number, demonstration in enumerate(demonstrations(task.contact_map), start=1):
        key = (task.object_name, task.task, number, task.seed)
        ranges = scene.hand.grips.named(demonstration.grip).shape
        cost = partial(preshape_cost, scene, ranges=ranges, settings=settings.grip_shape)
        kept = settings.grip_shape.kept
        draw = rng("synthesis", *key)
        terms: list[Array] = []
        trials: list[GraspTrial] = []
        for _ in range(settings.ranking.searches):
            ranked = search_session(scene, demonstration, settings, draw)
            found = list(_until_kept(ranked, tester, cost, kept, settings.ranking.load_tries))
            trials.extend(found)
            terms.extend(ranked.terms[: len(found)])
            if any(not trial.reason for trial in found):
                break
        best = _best(trials, kept)
        rows = [
            _row(scene, key, terms[rank], trial, rank, tester.validity)
            for rank, trial in enumerate(trials)
        ]
        attempts.extend({**row, "chosen": rank == best} for rank, row in enumerate(rows))
        grasps.append(
            {
                **rows[best],
                "tries": len(rows),
                "grip": demonstration.grip,
                **_contacts(scene.hand, trials[best]),
            }
        )
        reasons = ", ".join(trial.reason or "valid" for trial in trials)
        LOGGER.info("%s %s session %d (%s): %s", *key[:3], demonstration.grip, reasons)
    return pd.DataFrame(grasps), pd.DataFrame(attempts)


def demonstrations(contact_map: ContactMap) -> Iterator[Demonstration]:
    """The demonstrations of a contact map, in the order of its sessions."""
    points = contact_map.points.astype(np.float64)
    normals = contact_map.normals.astype(np.float64)
    for session in range(len(contact_map.sessions)):
        yield Demonstration(
            points_m=points,
            normals=normals,
            contact=contact_map.sessions[session].astype(np.float64),
            grip=str(contact_map.grip[session]),
            approach=contact_map.approach[session].astype(np.float64),
            closing=contact_map.closing[session].astype(np.float64),
            centre_m=contact_map.centre_m[session].astype(np.float64),
        )


def _until_kept(
    ranked: RankedGrasps,
    tester: GraspTester,
    cost: Callable[[Array, Array], Array],
    kept: float,
    load_tries: int,
) -> Iterator[GraspTrial]:
    """Trials in order of rank, up to the first valid one that kept its grip and bears the load.

    After one that kept its grip but does not bear the load, up to `load_tries` others are tried.
    """
    hands, left_tries = ranked.hands, load_tries
    for T_object_hand, positions in zip(hands.T_object_hand, hands.joint_positions, strict=True):
        trial = tester.try_grasp(T_object_hand, positions)
        held = HandStates(hands.hand, trial.T_object_hand[None], trial.joint_positions[None])
        left = float(cost(held.link_poses(), held.joint_positions)[0])
        yield trial._replace(deviation=left)
        if trial.reason or left > kept:
            continue
        if trial.bears_load or left_tries == 0:
            return
        left_tries -= 1


def _best(trials: Sequence[GraspTrial], kept: float) -> int:
    """The first valid trial that kept its grip and bears the load, or else kept its grip.

    If none kept its grip, it is the least deviating valid one; if none is valid, the first.
    """
    valid = [rank for rank, trial in enumerate(trials) if not trial.reason]

    def shortcomings(rank: int) -> tuple[float, bool]:
        """What makes a trial worse, the more important first."""
        trial = trials[rank]
        return max(trial.deviation, kept), not trial.bears_load

    return min(valid, key=shortcomings, default=0)


def _row(
    scene: GraspScene,
    key: tuple[str, str, int, int],
    terms: Array,
    trial: GraspTrial,
    rank: int,
    validity: ValiditySettings,
) -> Mapping[str, Any]:
    hand = scene.hand
    before, opened = pregrasp(scene, trial.T_object_touching, trial.touching_positions)
    numbers = configuration.pack(rank, trial.T_object_hand, hand.dofs_of(trial.joint_positions))
    return {
        "object": key[0],
        "task": key[1],
        "session": key[2],
        "rank": rank,
        "energy": float(terms.sum()),
        **dict(zip(ENERGY_TERMS, terms.tolist(), strict=True)),
        "hand_configuration": numbers.tolist(),
        "joint_angles_rad": trial.joint_positions.tolist(),
        "stopped_joints": list(trial.stages),
        "touching_pose": _pose_numbers(trial.T_object_touching),
        "touching_joints": trial.touching_positions.tolist(),
        "pregrasp_pose": _pose_numbers(before),
        "pregrasp_joints": opened.tolist(),
        "penetration_m": trial.penetration_m,
        "moved_m": trial.moved_m,
        "turned_rad": trial.turned_rad,
        "grip_deviation": trial.deviation,
        "bears_load": trial.bears_load,
        "valid": not trial.reason,
        "valid_strict": not trial.reason and trial.penetration_m <= validity.strict_depth_m,
        "reason": trial.reason,
        "seed": seed("synthesis", *key),
    }


def _pose_numbers(T: Array) -> list[float]:
    numbers: list[float] = T[:3].ravel().tolist()
    return numbers


def _contacts(hand: Hand, trial: GraspTrial) -> Mapping[str, Any]:
    points = [number for contact in trial.contacts for number in contact.point_m.tolist()]
    normals = [number for contact in trial.contacts for number in contact.normal.tolist()]
    return {
        "contact_links": [hand.link_names[contact.link] for contact in trial.contacts],
        "contact_points_m": points,
        "contact_normals": normals,
        "contact_forces_n": [contact.force_n for contact in trial.contacts],
    }
