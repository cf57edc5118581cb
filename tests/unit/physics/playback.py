"""Grasps of a ball that one process records in a file and another plays back.

Run as `python -m tests.unit.physics.playback record|play FOLDER ENGINE`, and writes a line per
grasp: whether the ball was dropped, how far it moved, and the stages of the joints.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

from grasptypes.runtime import pin_runtime

if __name__ == "__main__":
    pin_runtime()  # as every command does, before NumPy is imported

import numpy as np
import pandas as pd
from synthesis_cases import ball_object, closed, palm_at, scene_of
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.labels.recorded import cell, recorded_grasp
from grasptypes.physics.engines import engine
from grasptypes.physics.holding import hold
from grasptypes.seeds import rng
from grasptypes.synthesis.candidates import pregrasp

ROWS = 100
SHORT = {"squeeze_time_s": 0.2, "hold_time_s": 0.3, "shake": False}
SETTINGS = PARAMS.physics.test.changed(**SHORT)


def drawn_hands() -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Hands around the ball, of which some hold it and others do not."""
    draw = rng("test", "playback")
    for _ in range(ROWS):
        T = palm_at(draw.uniform(0.03, 0.12))
        T[0, 1, 3] += draw.normal(0.0, 0.01)
        yield T[0], closed(T, draw.uniform(0.0, 0.5))[0]


def record(world, file: Path) -> Iterator:
    rows = []
    for T, positions in drawn_hands():
        held = hold(world, T, positions)
        before, opened = pregrasp(scene_of(), T, positions)
        rows.append(
            {
                "HandConfiguration": cell([0.0, *held.T_object_hand[:3].ravel(), *([0.0] * 4)]),
                **{f"{joint}_rad": 0.0 for joint in BARRETT.joint_names},
                "stopped_joints": cell(held.stages),
                "touching_pose": cell(T[:3].ravel()),
                "touching_joints": cell(positions),
                "pregrasp_pose": cell(before[:3].ravel()),
                "pregrasp_joints": cell(opened),
            }
        )
        yield held
    pd.DataFrame(rows).to_csv(file, index=False)


def play(world, file: Path) -> Iterator:
    for _, row in pd.read_csv(file, dtype={"stopped_joints": str}).iterrows():
        grasp = recorded_grasp(row, BARRETT)
        yield hold(world, grasp.T_object_touching, grasp.touching_positions)


if __name__ == "__main__":
    mode, folder, name = sys.argv[1:]
    with engine(name, BARRETT, ball_object(Path(folder)), SETTINGS) as world:
        for held in {"record": record, "play": play}[mode](world, Path(folder, "grasps.csv")):
            stages = ",".join(map(str, held.stages))
            sys.stdout.write(f"{int(held.dropped)} {held.moved_m.hex()} {stages}\n")
