"""Hands beside each other."""

import shutil
from pathlib import Path

import pandas as pd
import pytest
from benchmarks.hand_kinematics import kinematics_errors
from benchmarks.hands import MEASURES, checkouts, join_tables, outcomes

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


def test_other_hands_are_those_that_make_hand_computed(tmp_path: Path, monkeypatch) -> None:
    (tmp_path / "hands/own/data").mkdir(parents=True)
    (tmp_path / "hands/own/reports").mkdir()
    (tmp_path / "hands/half_made").mkdir()
    row = pd.DataFrame([{"model": "no_task", "sim_mean": 0.5}])
    row = row.reindex(columns=["model", *MEASURES])
    row.to_csv(tmp_path / "hands/own/reports/table1.csv", index=False)
    monkeypatch.chdir(tmp_path)
    folders = checkouts("usual")
    assert folders == {"usual": Path(), "own": Path("hands/own")}
    joined = join_tables(folders)
    assert joined[["hand", "model", "sim_mean"]].to_numpy().tolist() == [["own", "no_task", 0.5]]


def test_grasps_are_counted_by_why_they_fail() -> None:
    grasps = pd.DataFrame({"valid": [True, False, False], "reason": ["", "dropped", "dropped"]})
    counted = outcomes(grasps)
    assert (counted["grasps"], counted["valid"], counted["dropped"]) == (3, 1, 2)
    assert counted["penetrates"] == 0
