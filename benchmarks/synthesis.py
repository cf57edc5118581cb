"""Speed of searching and testing grasps, on one core."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pybullet
from benchmarks.figures import Figure, NotReady, figure, rates, seconds

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.hands.reading import load_hand
from grasptypes.hands.states import HandStates
from grasptypes.objects.object_geometry import read_object
from grasptypes.physics.bullet_engine import BulletEngine, bullet_engine
from grasptypes.physics.holding import hold
from grasptypes.seeds import rng
from grasptypes.settings.params import Params
from grasptypes.settings.synthesis import SynthesisSettings
from grasptypes.synthesis.candidates import Demonstration, draw_candidates
from grasptypes.synthesis.energy import closeness, draw_targets, energies
from grasptypes.synthesis.fields import distances
from grasptypes.synthesis.hand_model import sample_hand
from grasptypes.synthesis.scene import GraspScene, grasp_scene
from grasptypes.synthesis.search import search_session
from grasptypes.synthesis.tester import GraspTester
from grasptypes.synthesis.trials import (
    SynthesisTask,
    demonstrations,
    synthesize_sessions,
)


class Case(NamedTuple):
    """The sessions that are synthesized, and how."""

    task: SynthesisTask
    scene: GraspScene
    """With the coarse hand."""
    tester: GraspTester
    settings: SynthesisSettings


def measure(settings: Mapping[str, Any], params: Params) -> Iterator[Figure]:
    """Candidates, physics tests, and valid grasps with everything they need."""
    task = _load(settings, params)
    hand, surface_m = load_hand(params.hand), task.contact_map.points.astype(np.float64)
    models = sample_hand(hand, params.synthesis)
    scene = grasp_scene(hand, models.search, task.geometry, surface_m)
    with bullet_engine(hand, task.geometry, params.physics.test) as world:
        check = scene._replace(model=models.check)
        tester = GraspTester(check, partial(hold, world), params.physics.validity)
        case = Case(task, scene, tester, params.synthesis)
        yield _candidates(case, settings["rounds"])
        tests = _tests(case, world, settings["rounds"])
        yield tests
        begun = time.process_time()
        grasps, _ = synthesize_sessions(*case)
        hours = (time.process_time() - begun) / 3600
    # Reference: every first grasp holds, and no search is needed.
    valid = float(grasps.valid.sum()) / hours
    yield figure("valid grasps, beside tests alone", valid, "1/core-hour", tests.value * 3600)


def _load(settings: Mapping[str, Any], params: Params) -> SynthesisTask:
    name, task = settings["object"], settings["task"]
    contact_map = read_contact_map(f"data/contact_maps/{name}/{task}.npz")
    some = replace(contact_map, sessions=contact_map.sessions[: settings["sessions"]])
    return SynthesisTask(name, task, read_object(Path("data/objects") / name), some, params.seed)


def _candidates(case: Case, rounds: int) -> Figure:
    """Hands placed, closed and evaluated, compared with one distance lookup per point."""
    shown, number = list(demonstrations(case.task.contact_map)), case.settings.candidates.number
    points = np.tile(case.scene.model.points, (number, 1))

    def place() -> None:
        for index, demonstration in enumerate(shown):
            _place(case, demonstration, rng("benchmark", index))

    def look_up() -> None:
        for _ in shown:
            distances(case.scene.field, points)

    taken_s = seconds(place, look_up, rounds=rounds, clock=time.process_time)
    return rates("candidates, beside look-ups of their points", "1/s", taken_s, len(shown) * number)


def _place(case: Case, demonstration: Demonstration, draw: np.random.Generator) -> None:
    scene, settings = case.scene, case.settings
    targets = draw_targets(demonstration, settings.energy, draw)
    hands = draw_candidates(scene, demonstration, settings.candidates, settings.closing, draw)
    poses = hands.link_poses()
    energies(scene.model, poses, closeness(scene, poses), targets, settings.energy)


def _tests(case: Case, world: BulletEngine, rounds: int) -> Figure:
    """The test of a grasp that holds, compared with as many bare time steps of hand and object."""
    hands = _holding(case, world)
    before = world.steps
    test = partial(hold, world, hands.T_object_hand[0], hands.joint_positions[0])
    test()
    steps = world.steps - before

    def step() -> None:
        for _ in range(steps):
            pybullet.stepSimulation(physicsClientId=world.client)

    taken_s = seconds(test, step, rounds=rounds, clock=time.process_time)
    return rates("physics tests, beside their bare time steps", "1/s", taken_s, done=1)


def _holding(case: Case, world: BulletEngine) -> HandStates:
    """The best grasp of the first session whose best grasp holds."""
    for number, demonstration in enumerate(demonstrations(case.task.contact_map)):
        draw = rng("benchmark", number)
        hands = search_session(case.scene, demonstration, case.settings, draw).hands
        if not hold(world, hands.T_object_hand[0], hands.joint_positions[0]).dropped:
            return hands
    raise NotReady("no session's best grasp holds")
