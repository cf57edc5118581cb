"""How fast grasps are searched and tested, on one core."""

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
from grasptypes.hand import kinematics
from grasptypes.seeds import rng
from grasptypes.synthesis.candidates import Hands, Person, draw_candidates
from grasptypes.synthesis.energy import closeness, draw_targets, energies
from grasptypes.synthesis.fields import distances
from grasptypes.synthesis.holding import PhysicsSettings, read_body
from grasptypes.synthesis.physics import Physics, physics
from grasptypes.synthesis.search import SearchSettings, read_thing, search_session
from grasptypes.synthesis.settings import sampled_hand, search_settings
from grasptypes.synthesis.trials import Hand, Problem, ValiditySettings, people, synthesize

URDF = Path("assets/barrett_hand/barrett_hand.urdf")


class Case(NamedTuple):
    """The sessions that are synthesized, and how."""

    problem: Problem
    hand: Hand
    search: SearchSettings
    validity: ValiditySettings


def measure(settings: Mapping[str, Any], params: Mapping[str, Any]) -> Iterator[Figure]:
    """Candidates, physics tests, and valid grasps with all that they take."""
    folder, test = Path("data/objects") / settings["object"], params["physics"]["test"]
    body = read_body(folder / "collision.obj", folder / "properties.json")
    case = _load(settings, params, folder)
    yield _candidates(case, settings["rounds"])
    with physics(URDF, body, PhysicsSettings(**test)) as world:
        tests = _tests(case, world, settings["rounds"])
        yield tests
        begun = time.process_time()
        grasps, _ = synthesize(case.problem, case.hand, world, case.search, case.validity)
        hours = (time.process_time() - begun) / 3600
    # The reference: every first grasp holds, and nothing has to be searched.
    valid = float(grasps.valid.sum()) / hours
    yield figure("valid grasps, beside tests alone", valid, "1/core-hour", tests.value * 3600)


def _load(settings: Mapping[str, Any], params: Mapping[str, Any], folder: Path) -> Case:
    name, task = settings["object"], settings["task"]
    contact_map = read_contact_map(f"data/contact_maps/{name}/{task}.npz")
    some = replace(contact_map, sessions=contact_map.sessions[: settings["sessions"]])
    thing = read_thing(folder / "distance_grid.npz", folder / "properties.json", contact_map)
    return Case(
        Problem(name, task, thing, some, params["seed"]),
        sampled_hand(params["synthesis"]),
        search_settings(params["synthesis"]),
        ValiditySettings(**params["physics"]["validity"]),
    )


def _candidates(case: Case, rounds: int) -> Figure:
    """Hands placed, closed and given an energy, beside one look-up of distance a point of each."""
    model, grid = case.hand.search, case.problem.thing.grid
    persons = list(people(case.problem.contact_map))
    hands = len(persons) * case.search.candidates.number
    points = np.tile(model.points, (case.search.candidates.number, 1))

    def place() -> None:
        for number, person in enumerate(persons):
            _place(case, person, rng("benchmark", number))

    def look_up() -> None:
        for _ in persons:
            distances(grid, points)

    taken_s = seconds(place, look_up, rounds=rounds, clock=time.process_time)
    return rates("candidates, beside look-ups of their points", "1/s", taken_s, hands)


def _place(case: Case, person: Person, draw: np.random.Generator) -> None:
    model, grid, search = case.hand.search, case.problem.thing.grid, case.search
    targets = draw_targets(person.points_m, person.normals, person.contact, search.energy, draw)
    hands = draw_candidates(model, grid, person, search.candidates, search.closing, draw)
    poses = hands.T_object_hand[:, None] @ kinematics.link_poses(hands.joint_angles_rad)
    energies(model, poses, closeness(model, grid, poses), targets, search.energy)


def _tests(case: Case, world: Physics, rounds: int) -> Figure:
    """The test of a grasp that holds, beside as many bare time steps of hand and object."""
    hands = _holding(case, world)
    before = world.steps
    hold = partial(world.hold, hands.T_object_hand[0], hands.joint_angles_rad[0])
    hold()
    steps = world.steps - before

    def step() -> None:
        for _ in range(steps):
            pybullet.stepSimulation(physicsClientId=world._client)

    taken_s = seconds(hold, step, rounds=rounds, clock=time.process_time)
    return rates("physics tests, beside their bare time steps", "1/s", taken_s, done=1)


def _holding(case: Case, world: Physics) -> Hands:
    """The best grasp of the first session whose best grasp holds."""
    search, thing = partial(search_session, case.hand.search), case.problem.thing
    for number, person in enumerate(people(case.problem.contact_map)):
        hands = search(thing, person, case.search, rng("benchmark", number)).hands
        if not world.hold(hands.T_object_hand[0], hands.joint_angles_rad[0]).dropped:
            return hands
    raise NotReady("no session's best grasp holds")
