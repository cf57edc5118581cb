"""Hands beside each other."""

import shutil
from pathlib import Path

import pandas as pd
import pytest
from benchmarks.hands import grasp_folders, kinematics_errors, outcomes

from grasptypes.hands.folders import hand_names
from grasptypes.hands.reading import load_hand

TENTH_MM = 1e-4


@pytest.mark.parametrize("name", hand_names())
def test_engines_move_the_urdf_of_a_hand_as_its_kinematics_do(name: str) -> None:
    assert max(kinematics_errors(load_hand(name), number=50)) < TENTH_MM


def test_a_palm_that_is_elsewhere_is_noticed(tmp_path: Path) -> None:
    folder = shutil.copytree(load_hand("robotiq_3f").folder, tmp_path / "hand")
    hand, description = load_hand(folder), folder / "hand.yaml"
    text = description.read_text()
    assert "xyz_m: [0.0, 0.0508, 0.0]" in text
    description.write_text(text.replace("xyz_m: [0.0, 0.0508, 0.0]", "xyz_m: [0.0, 0.051, 0.0]"))
    assert kinematics_errors(hand, number=3) == pytest.approx((0.0002, 0.0002), rel=1e-3)


def test_grasps_of_other_hands_are_those_that_make_hand_made(tmp_path: Path, monkeypatch) -> None:
    (tmp_path / "hands/own/data/grasps").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    assert grasp_folders("usual") == {
        "usual": Path("data/grasps"),
        "own": Path("hands/own/data/grasps"),
    }


def test_grasps_are_counted_by_why_they_fail() -> None:
    grasps = pd.DataFrame({"valid": [True, False, False], "reason": ["", "dropped", "dropped"]})
    counted = outcomes(grasps)
    assert (counted["grasps"], counted["valid"], counted["dropped"]) == (3, 1, 2)
    assert counted["penetrates"] == 0
