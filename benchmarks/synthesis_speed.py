"""How fast grasps are searched and tested, on one core, beside the raw step rate of PyBullet.

Run from the repository, after `snakemake contact_maps`, on an idle machine:

    OMP_NUM_THREADS=1 python benchmarks/synthesis_speed.py hammer use

Compiled functions are run once before the clock starts; times are the process's own.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pybullet
import yaml

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.hand import kinematics
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.object_files import read_properties
from grasptypes.seeds import rng
from grasptypes.synthesis.candidates import draw_candidates
from grasptypes.synthesis.energy import closeness, draw_targets, energies
from grasptypes.synthesis.fields import field
from grasptypes.synthesis.holding import PhysicsSettings, read_body
from grasptypes.synthesis.physics import Physics, physics
from grasptypes.synthesis.search import SearchSettings, Thing, search_session
from grasptypes.synthesis.settings import sampled_hand, search_settings
from grasptypes.synthesis.trials import Hand, Problem, ValiditySettings, people, synthesize

URDF = Path("assets/barrett_hand/barrett_hand.urdf")


class Case(NamedTuple):
    """What is measured."""

    problem: Problem
    hand: Hand
    search: SearchSettings
    validity: ValiditySettings


def load(object_name: str, task: str, params: dict) -> Case:
    """The files of an object and task below data/."""
    folder = Path("data/objects") / object_name
    contact_map = read_contact_map(f"data/contact_maps/{object_name}/{task}.npz")
    thing = Thing(
        field(DistanceGrid.load(folder / "distance_grid.npz")),
        np.array(read_properties(folder / "properties.json")["centre_of_mass_m"]),
        float(np.ptp(contact_map.points, axis=0).max() / 2),
    )
    return Case(
        Problem(object_name, task, thing, contact_map, params["seed"]),
        sampled_hand(params["synthesis"]),
        search_settings(params["synthesis"]),
        ValiditySettings(**params["physics"]["validity"]),
    )


def candidates_per_second(case: Case) -> float:
    """Candidates placed, closed and given an energy."""
    model, grid, search = case.hand.search, case.problem.thing.grid, case.search
    done, start = 0, time.process_time()
    for number, person in enumerate(people(case.problem.contact_map)):
        draw = rng("benchmark", number)
        targets = draw_targets(person.points_m, person.normals, person.contact, search.energy, draw)
        hands = draw_candidates(model, grid, person, search.candidates, search.closing, draw)
        poses = hands.T_object_hand[:, None] @ kinematics.link_poses(hands.joint_angles_rad)
        energies(model, poses, closeness(model, grid, poses), targets, search.energy)
        done += len(poses)
    return done / (time.process_time() - start)


def searches_per_second(case: Case) -> float:
    """Sessions searched, refinement and ranking included."""
    start, sessions = time.process_time(), list(people(case.problem.contact_map))
    for number, person in enumerate(sessions):
        draw = rng("benchmark", number)
        search_session(case.hand.search, case.problem.thing, person, case.search, draw)
    return len(sessions) / (time.process_time() - start)


def tests_per_second(case: Case, world: Physics) -> tuple[float, float]:
    """Tests of the best grasps of every session, and the time steps a second within them."""
    search, thing, tests = case.search, case.problem.thing, 0
    ranked = [
        search_session(case.hand.search, thing, person, search, rng("benchmark", number))
        for number, person in enumerate(people(case.problem.contact_map))
    ]
    before, start = world.steps, time.process_time()
    for found in ranked:
        world.hold(found.hands.T_object_hand[0], found.hands.joint_angles_rad[0])
        tests += 1
    seconds = time.process_time() - start
    return tests / seconds, (world.steps - before) / seconds


def raw_steps_per_second(settings: PhysicsSettings, steps: int = 4000) -> float:
    """Time steps of the hand alone, without an object and without commands."""
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setPhysicsEngineParameter(
        fixedTimeStep=settings.timestep_s,
        numSolverIterations=settings.solver_iterations,
        physicsClientId=client,
    )
    flags = pybullet.URDF_USE_INERTIA_FROM_FILE | pybullet.URDF_USE_SELF_COLLISION
    pybullet.loadURDF(str(URDF), useFixedBase=True, flags=flags, physicsClientId=client)
    start = time.process_time()
    for _ in range(steps):
        pybullet.stepSimulation(physicsClientId=client)
    rate = steps / (time.process_time() - start)
    pybullet.disconnect(client)
    return rate


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("object")
    parser.add_argument("task")
    chosen = parser.parse_args()
    params = yaml.safe_load(Path("params.yaml").read_text())
    case = load(chosen.object, chosen.task, params)
    folder = Path("data/objects") / chosen.object
    body = read_body(folder / "collision.obj", folder / "properties.json")
    settings = PhysicsSettings(**params["physics"]["test"])
    searches_per_second(case)
    with physics(URDF, body, settings) as world:
        tests, steps = tests_per_second(case, world)
        start = time.process_time()
        grasps, attempts = synthesize(case.problem, case.hand, world, case.search, case.validity)
        seconds = time.process_time() - start
    figures = {
        "candidates/s": candidates_per_second(case),
        "sessions searched/s": searches_per_second(case),
        "physics tests/s": tests,
        "PyBullet steps/s in tests": steps,
        "PyBullet steps/s, hand alone": raw_steps_per_second(settings),
        "grasps": len(grasps),
        "valid": int(grasps.valid.sum()),
        "attempts": len(attempts),
        "valid grasps per core-hour": 3600 * grasps.valid.sum() / seconds,
    }
    for name, value in figures.items():
        sys.stdout.write(f"{name:30} {value:12,.1f}\n")


if __name__ == "__main__":
    main()
