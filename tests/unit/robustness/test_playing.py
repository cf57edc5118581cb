"""What is shown: a play shakes from six sides and ends when the object is gone."""

import numpy as np
from synthesis_cases import ball_object, closed, palm_at
from tests.unit.barrett import BARRETT
from tests.unit.robustness.test_robustness_tables import table_of
from tests.unit.settings import PARAMS

from grasptypes.labels.recorded import RecordedGrasp
from grasptypes.physics.engines import engine
from grasptypes.robustness.playing import (
    displacement,
    lost_grasps,
    most_robust,
    play,
    withstands,
    worst,
)

SETTINGS = PARAMS.physics.test
TESTS = table_of([(6, 6), (3, 2), (6, 1), (6, 6)], True)


def grasp(T, positions) -> RecordedGrasp:
    return RecordedGrasp(T, positions, T, positions, T, positions, (0, 0, 0))


def test_a_held_ball_is_shaken_from_six_sides_and_a_free_one_is_soon_gone(tmp_path) -> None:
    T = palm_at(0.04)[0]
    with engine("mujoco", BARRETT, ball_object(tmp_path), SETTINGS) as world:
        held = list(play(world, grasp(T, closed(T[None], 0.0)[0]), 0.1, 0.2, 0.1))
        free = list(play(world, grasp(palm_at(0.5)[0], np.zeros(8)), 0.1, 0.5, 0.1))
    assert len({frame.happening for frame in held}) == 7
    assert len(held) == 5 + 6 * 2
    assert free[-1].happening == "gravity along -z"
    assert displacement(held) < 0.01
    assert displacement(free) > 0.1


def test_the_worst_come_first_and_the_best_is_shown() -> None:
    assert worst(TESTS, 2).index.tolist() == [1, 2]
    assert most_robust(TESTS) == 3
    assert lost_grasps(TESTS, "pybullet") == [1]
    assert lost_grasps(TESTS, "mujoco") == [1, 2]
    assert withstands(TESTS.loc[1]) == "pybullet 3 of 6, mujoco 2 of 6, no load, 33%"
