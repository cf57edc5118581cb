"""A grasp that is read back from its file behaves as recorded, in a new process."""

import os
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from synthesis_cases import ball_object, closed, palm_at, scene_of
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.labels.recorded import cell
from grasptypes.physics.engines import engine
from grasptypes.physics.holding import hold
from grasptypes.seeds import rng
from grasptypes.synthesis.candidates import pregrasp

ROWS = 100
SHORT = {"squeeze_time_s": 0.2, "hold_time_s": 0.3, "shake": False}
SETTINGS = PARAMS.physics.test.changed(**SHORT)
READ_AND_HOLD = """
import sys
import numpy as np, pandas as pd
from pathlib import Path
from grasptypes.hands.reading import load_hand
from grasptypes.labels.recorded import recorded_grasp
from grasptypes.physics.engines import engine
from grasptypes.physics.holding import hold
from synthesis_cases import ball_object
from tests.unit.settings import PARAMS
file, name = sys.argv[1:]
hand, settings = load_hand("barrett"), PARAMS.physics.test.changed(**{short})
with engine(name, hand, ball_object(Path(file).parent), settings) as world:
    for _, row in pd.read_csv(file, dtype={{"stopped_joints": str}}).iterrows():
        grasp = recorded_grasp(row, hand)
        held = hold(world, grasp.T_object_touching, grasp.touching_positions)
        print(int(held.dropped), held.moved_m.hex(), ",".join(map(str, held.stages)))
"""


def drawn_hands():
    """Hands around the ball of which some hold it and others do not."""
    draw = rng("test", "playback")
    for _ in range(ROWS):
        T = palm_at(draw.uniform(0.03, 0.12))
        T[0, 1, 3] += draw.normal(0.0, 0.01)
        yield T[0], closed(T, draw.uniform(0.0, 0.5))[0]


@pytest.mark.parametrize("name", ["pybullet", "mujoco"])
def test_rows_of_a_file_behave_as_recorded(name, tmp_path) -> None:
    rows, recorded = [], []
    with engine(name, BARRETT, ball_object(tmp_path), SETTINGS) as world:
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
            stages = ",".join(map(str, held.stages))
            recorded.append(f"{int(held.dropped)} {held.moved_m.hex()} {stages}")
    dropped = sum(line.startswith("1") for line in recorded)
    assert 5 < dropped < ROWS - 5
    pd.DataFrame(rows).to_csv(tmp_path / "grasps.csv", index=False)
    code = READ_AND_HOLD.format(short=SHORT)
    found = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "grasps.csv"), name],
        check=True,
        capture_output=True,
        text=True,
        # The instruction sets of this process, which tests do not pin.
        env=os.environ | {"PYTHONPATH": ":".join(path for path in sys.path if path)},
    )
    again = [line for line in found.stdout.splitlines() if line[:2] in ("0 ", "1 ")]
    same = [one == other for one, other in zip(recorded, again, strict=True)]
    assert np.mean(same) >= 0.99


def test_the_pregrasp_is_open_and_in_front_of_the_whole_object() -> None:
    T, positions = palm_at(0.05)[0], closed(palm_at(0.05), 0.3)[0]
    before, opened = pregrasp(scene_of(), T, positions)
    np.testing.assert_array_equal(before[:3, :3], T[:3, :3])
    assert before[2, 3] == pytest.approx(0.03 + BARRETT.grips.start_m)
    np.testing.assert_allclose(opened, [0.3, 0.3, 0, 0, 0, 0, 0, 0])
