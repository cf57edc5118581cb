"""Tests of a recorded grasp: playback, six directions, the task's load, perturbations.

Every test starts from the touching hand and closes it, as a robot would; only `holds_again` starts
from the held state.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.labels.dataset import VALID
from grasptypes.labels.recorded import RecordedGrasp, recorded_grasp
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.physics.engine import Engine, Surroundings
from grasptypes.physics.engines import ENGINES, engine
from grasptypes.physics.holding import DIRECTIONS, Motion, bear, bears_load, hold, squeeze
from grasptypes.physics.loads import TaskLoad, task_load
from grasptypes.physics.wrench_space import Body, wrench_space
from grasptypes.poses import inverse
from grasptypes.seeds import rng
from grasptypes.settings.physics import EngineName, PhysicsSettings
from grasptypes.settings.robustness import LossSettings, RobustnessSettings
from grasptypes.settings.synthesis import SynthesisSettings
from grasptypes.settings.tasks import read_tasks
from grasptypes.synthesis.closing import close_fingers
from grasptypes.synthesis.hand_model import sample_hand
from grasptypes.synthesis.scene import GraspScene, grasp_scene

Array = NDArray[np.float64]


class GraspTestsSettings(NamedTuple):
    """All that the tests depend on."""

    physics: PhysicsSettings
    robustness: RobustnessSettings
    synthesis: SynthesisSettings
    """How fingers close on an object whose place is slightly off."""
    seed: int


def test_grasps(
    dataset: pd.DataFrame, hand: Hand, geometry: ObjectGeometry, settings: GraspTestsSettings
) -> pd.DataFrame:
    """Test the grasps of one object.

    Args:
        dataset: rows of `dataset.dataset_schema`, read from their file.

    Returns:
        A table that meets `tables.ROBUSTNESS_SCHEMA`.
    """
    surface_m = np.asarray(geometry.surface.vertices, dtype=np.float64)
    scene = grasp_scene(hand, sample_hand(hand, settings.synthesis).search, geometry, surface_m)
    loads = {
        task: task_load(read_tasks()[task], geometry, settings.physics.gravity_m_s2)
        for task in sorted(set(dataset.Intent))
    }
    loose = loose_test(settings)
    rows = []
    with ExitStack() as stack:
        worlds = {
            name: stack.enter_context(engine(name, hand, geometry, loose)) for name in ENGINES
        }
        for _, row in dataset.iterrows():
            tested = GraspTests(scene, worlds, settings, recorded_grasp(row, hand))
            key = {"Object": row.Object, "Intent": row.Intent, "Session": row.Session}
            draw = rng("robustness", *key.values(), settings.seed)
            results = {"valid": row.reason == VALID, **tested.results(loads[row.Intent], draw)}
            rows.append({**key, **results})
    return pd.DataFrame(rows)


def loose_test(settings: GraspTestsSettings) -> PhysicsSettings:
    """The dataset's own test, with the holding time and the limits of these tests."""
    how = settings.robustness
    return settings.physics.changed(
        hold_time_s=how.hold_time_s,
        drop_distance_m=how.loss.distance_m,
        drop_rotation_rad=how.loss.rotation_rad,
    )


class GraspTests(NamedTuple):
    """The tests of one grasp, in all engines."""

    scene: GraspScene
    worlds: Mapping[EngineName, Engine]
    settings: GraspTestsSettings
    grasp: RecordedGrasp

    def results(self, load: TaskLoad, draw: np.random.Generator) -> dict[str, Any]:
        """The columns of a grasp."""
        found: dict[str, Any] = {}
        for name, world in self.worlds.items():
            found |= {f"{key}_{name}": value for key, value in self._of_engine(world, load).items()}
        share = float(np.mean(list(self._perturbed(draw))))
        return {**found, "robustness": share, **self._wrench_space()}

    def _of_engine(self, world: Engine, load: TaskLoad) -> dict[str, Any]:
        grasp, test = self.grasp, self.settings.physics
        motions = [self._motion(world, direction) for direction in DIRECTIONS]
        world.settings = test
        played = hold(world, grasp.T_object_touching, grasp.touching_positions)
        again = hold(world, grasp.T_object_held, grasp.held_positions, grasp.stages)
        world.settings = self._loose
        return {
            "plays_back": not played.dropped,
            "holds_again": not again.dropped,
            "directions": sum(not motion.lost for motion in motions),
            "strict_directions": sum(
                not _lost(motion, self.settings.robustness.strict_loss) for motion in motions
            ),
            "creep_m_s": _median_creep(motions),
            "bears_load": self._bears_load(world, load),
        }

    @property
    def _loose(self) -> PhysicsSettings:
        return loose_test(self.settings)

    def _motion(self, world: Engine, direction: Array) -> Motion:
        """The motion under gravity in one direction (3,) of the object's frame."""
        T = self.grasp.T_object_touching
        motors = squeeze(world, T, self.grasp.touching_positions)
        return bear(world, motors, T[:3, :3].T @ direction * world.settings.gravity_m_s2)

    def _bears_load(self, world: Engine, load: TaskLoad) -> bool:
        """Whether it holds under gravity and the task's load."""
        T = self.grasp.T_object_touching
        return bears_load(world, squeeze(world, T, self.grasp.touching_positions), T, load)

    def _perturbed(self, draw: np.random.Generator) -> Iterator[bool]:
        """Whether the grasp holds, for each draw of friction, mass and place of the hand."""
        how, T = self.settings.robustness.perturbations, self.grasp.T_object_touching
        world = self.worlds[how.engine]
        count = how.draws
        friction = draw.uniform(*how.friction, count)
        low, high = np.log(how.mass_share)
        mass = np.exp(draw.uniform(low, high, count))
        T_off = np.repeat(T[None], count, axis=0)
        T_off[:, :3, 3] += how.position_m * _units(draw, count)
        turned = Rotation.from_rotvec(how.rotation_rad * _units(draw, count))
        T_off[:, :3, :3] = T_off[:, :3, :3] @ turned.as_matrix()
        hand, closing = self.scene.hand, self.settings.synthesis.closing
        preshape = hand.preshape_of(self.grasp.touching_positions)
        hands = close_fingers(self.scene, T_off, np.repeat(preshape[None], count, axis=0), closing)
        for index, states in enumerate(_each(hands)):
            surroundings = Surroundings(float(friction[index]), float(mass[index]))
            motors = squeeze(world, *states, world=surroundings)
            down = states[0][:3, :3].T @ DIRECTIONS[0] * world.settings.gravity_m_s2
            yield not bear(world, motors, down, how.hold_time_s).lost

    def _wrench_space(self) -> dict[str, float]:
        """Size of the wrench space of the squeezed grasp, in the first engine."""
        world, grasp, hand = self.worlds[ENGINES[0]], self.grasp, self.scene.hand
        motors = squeeze(world, grasp.T_object_touching, grasp.touching_positions)
        T_object_hand = inverse(world.T_hand_object())
        positions = world.joint_positions()
        space = wrench_space(
            world.contacts(),
            T_object_hand @ hand.link_poses(positions),
            hand,
            motors.drive(positions).passive_torques,
            Body(self.scene.centre_of_mass_m, self.scene.radius_m),
            world.settings.friction,
            self.settings.robustness.cone_edges,
        )
        return space._asdict()


def _each(hands: HandStates) -> Iterator[tuple[Array, Array]]:
    return zip(hands.T_object_hand, hands.joint_positions, strict=True)


def _units(draw: np.random.Generator, count: int) -> Array:
    """(count, 3) unit vectors in random directions."""
    vectors = draw.normal(size=(count, 3))
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


def _lost(motion: Motion, loss: LossSettings) -> bool:
    return motion.moved_m > loss.distance_m or motion.turned_rad > loss.rotation_rad


def _median_creep(motions: Sequence[Motion]) -> float:
    """Median creep over the directions in which the object is held; infinite if in none."""
    held = [motion.creep_m_s for motion in motions if not motion.lost]
    return float(np.median(held)) if held else np.inf
