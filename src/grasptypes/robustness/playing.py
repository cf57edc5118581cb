"""A recorded grasp played for people to see: squeezed, then shaken from six sides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from grasptypes.labels.recorded import RecordedGrasp
from grasptypes.physics.engine import Engine
from grasptypes.physics.engines import ENGINES
from grasptypes.physics.holding import DIRECTIONS, load_and_couple, run
from grasptypes.robustness.tables import SIX
from grasptypes.settings.physics import EngineName

Array = NDArray[np.float64]

NAMES = ("-z", "-y", "-x", "+z", "+y", "+x")
"""Names of `DIRECTIONS`."""


class Frame(NamedTuple):
    """A moment of a play."""

    T_hand_object: Array
    """(4, 4)."""
    joint_positions: Array
    """(J,)."""
    happening: str
    """In words."""


def play(
    world: Engine, grasp: RecordedGrasp, frame_s: float, direction_s: float, lost_m: float
) -> Iterator[Frame]:
    """Frames of a grasp, from the touching hand on; the last one is where the object is lost.

    Args:
        frame_s: time between frames.
        direction_s: how long gravity acts in each direction.
        lost_m: distance at which the film ends.
    """
    settings, T = world.settings, grasp.T_object_touching
    motors = load_and_couple(world, T, grasp.touching_positions)
    intervals = max(1, round(frame_s / (settings.timestep_s * settings.control_steps)))
    start = world.T_hand_object()[:3, 3]
    acts = [("the fingers close", np.zeros(3), settings.squeeze_time_s)]
    acts += [
        (f"gravity along {name}", T[:3, :3].T @ direction * settings.gravity_m_s2, direction_s)
        for name, direction in zip(NAMES, DIRECTIONS, strict=True)
    ]
    for words, acceleration, time_s in acts:
        world.accelerate(acceleration)
        for _ in range(max(1, round(time_s / frame_s))):
            run(world, motors, intervals)
            T_hand_object = world.T_hand_object()
            yield Frame(T_hand_object, world.joint_positions(), words)
            if np.linalg.norm(T_hand_object[:3, 3] - start) > lost_m:
                return


def displacement(frames: Sequence[Frame]) -> float:
    """How far (m) the object is from where it was at the start of a play."""
    first, last = (frames[at].T_hand_object[:3, 3] for at in (0, -1))
    return float(np.linalg.norm(last - first))


def most_robust(tests: pd.DataFrame) -> int:
    """Index of the valid grasp that withstands most."""
    return int(_ranked(tests[tests.valid]).index[-1])


def lost_grasps(tests: pd.DataFrame, engine: EngineName) -> list[int]:
    """Indices of the valid grasps that are lost in an engine, those that fail most tests first."""
    ranked = _ranked(tests[tests.valid])
    return [int(index) for index in ranked.index[ranked[f"directions_{engine}"] < SIX]]


def worst(tests: pd.DataFrame, count: int) -> pd.DataFrame:
    """The valid grasps that fail most tests, the worst first."""
    return _ranked(tests[tests.valid]).head(count)


def _ranked(valid: pd.DataFrame) -> pd.DataFrame:
    directions = sum(valid[f"directions_{name}"] for name in ENGINES)
    order = valid.assign(held=directions).sort_values(
        ["held", "robustness", "epsilon_n", "Object", "Intent", "Session"], kind="stable"
    )
    return order.drop(columns="held")


def withstands(test: pd.Series) -> str:
    """What a grasp withstands, in a few words: sides in each engine, load, share of draws."""
    held = ", ".join(f"{name} {test[f'directions_{name}']} of {SIX}" for name in ENGINES)
    load = all(test[f"bears_load_{name}"] for name in ENGINES)
    return f"{held}, {'' if load else 'no '}load, {test.robustness:.0%}"
