"""Balance is found where contacts oppose each other, and missed where they do not."""

import numpy as np
import pytest
from synthesis_cases import closed, palm_at, scene_of
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.synthesis.equilibrium import _least_norm, wrench_residual

SETTINGS = PARAMS.synthesis.equilibrium


def test_nearest_point_of_a_hull() -> None:
    square = np.array([[1.0, 1.0], [1.0, -1.0], [3.0, 1.0], [3.0, -1.0]])
    assert _least_norm(square, 200) == pytest.approx(1.0, abs=1e-3)
    assert _least_norm(square - [2.0, 0.0], 200) == pytest.approx(0.0, abs=0.02)


def rest(angles, T):
    poses = T[:, None] @ BARRETT.link_poses(angles)
    return wrench_residual(scene_of(), poses, SETTINGS)[0]


def test_opposed_fingers_balance_and_one_alone_does_not() -> None:
    T = palm_at(0.1)
    together = closed(T, 1.0)
    alone = together.copy()
    alone[:, [2, 3, 5, 6]] = 0.0
    assert rest(together, T) < 0.15
    assert rest(alone, T) > 0.8


def test_nothing_touching_balances_nothing() -> None:
    assert rest(np.zeros((1, 8)), palm_at(0.5)) == 1.0
