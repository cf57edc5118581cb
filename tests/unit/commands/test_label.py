"""`grasptypes label`: types of grasps in a table, from any folder."""

import json
from pathlib import Path

import pandas as pd
import pytest
import trimesh

from grasptypes.__main__ import main

# Around a can of 60 mm by 120 mm: a power grasp, and one at the fingertips.
POSE = "{rank},0,1,0,0,0,0,-1,{y},-1,0,0,0"


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    trimesh.creation.cylinder(30, 120, sections=48).export("can.stl")
    return tmp_path


def cell(y_m: float, finger_rad: float) -> str:
    fingers = ",".join([str(finger_rad)] * 3)
    return f"{POSE.format(rank=0, y=y_m)},0,{fingers}"


def write(*cells: str, **columns: list[float]) -> None:
    pd.DataFrame({"HandConfiguration": cells, **columns}).to_csv("grasps.csv", index=False)


def labels(capsys: pytest.CaptureFixture[str], *more: str) -> list[dict[str, object]]:
    main(["label", "grasps.csv", "--object", "can.stl", "--unit", "mm", "--json", *more])
    return list(json.loads(capsys.readouterr().out))


def test_grasps_are_labelled_in_order_with_the_packaged_parameters(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(cell(0.03, 1.2), "", cell(0.09, 0.9))
    close, far = labels(capsys)
    assert str(close["branch"]).startswith("power: palm gap")
    assert str(far["branch"]).startswith("precision: palm gap")
    main(["label", "grasps.csv", "--object", "can.stl", "--unit", "mm"])
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "can.stl: 2 grasps"
    assert lines[2].split()[0] == "1"


def test_joint_columns_replace_the_coupled_fingers(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from grasptypes.hands.reading import load_hand
    from grasptypes.labels.dataset import joint_columns

    hand = load_hand("barrett")
    write(cell(0.03, 1.2))
    coupled = labels(capsys)
    positions = hand.couple([0, 1.2, 1.2, 1.2])
    names = joint_columns(hand)
    write(cell(0.03, 1.2), **{name: [value] for name, value in zip(names, positions, strict=True)})
    assert labels(capsys) == coupled
    positions[-3:] += 0.4
    write(cell(0.03, 1.2), **{name: [value] for name, value in zip(names, positions, strict=True)})
    assert labels(capsys) != coupled
