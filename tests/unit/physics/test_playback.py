"""A grasp that is read back from its file behaves as recorded, in a new process."""

import os
import subprocess
import sys

import numpy as np
import pytest
from synthesis_cases import closed, palm_at, scene_of
from tests.unit.barrett import BARRETT

from grasptypes.synthesis.candidates import pregrasp


def behaviour(mode: str, folder, engine: str) -> list[str]:
    """What a new process sees of each grasp (see `playback`)."""
    command = [sys.executable, "-m", "tests.unit.physics.playback", mode, str(folder), engine]
    path = {"PYTHONPATH": ":".join(filter(None, sys.path))}
    done = subprocess.run(command, check=True, stdout=-1, text=True, env=os.environ | path)
    return [line for line in done.stdout.splitlines() if line[:2] in ("0 ", "1 ")]


@pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
def test_rows_of_a_file_behave_as_recorded(engine, tmp_path) -> None:
    recorded = behaviour("record", tmp_path, engine)
    dropped = sum(line.startswith("1") for line in recorded)
    assert 5 < dropped < len(recorded) - 5
    again = behaviour("play", tmp_path, engine)
    same = [one == other for one, other in zip(recorded, again, strict=True)]
    assert np.mean(same) >= 0.99


def test_the_pregrasp_is_open_and_in_front_of_the_whole_object() -> None:
    T, positions = palm_at(0.05)[0], closed(palm_at(0.05), 0.3)[0]
    before, opened = pregrasp(scene_of(), T, positions)
    np.testing.assert_array_equal(before[:3, :3], T[:3, :3])
    assert before[2, 3] == pytest.approx(0.03 + BARRETT.grips.start_m)
    np.testing.assert_allclose(opened, [0.3, 0.3, 0, 0, 0, 0, 0, 0])
