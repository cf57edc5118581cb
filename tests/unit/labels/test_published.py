"""Reading the published table; more of what cannot be used is in tests/bad_input."""

import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from grasptypes.errors import InputError
from grasptypes.labels.published import read_published

CONFIGURATION = "0,1,0,0,0.1,0,1,0,0.2,0,0,1,0.3,0.5,1.0,1.1,1.2"
ROW = {
    "Index": "0",
    "Object": "mug",
    "Intent": "use",
    "Session": "1",
    "GraspType": "Precision Sphere",
    "GraspTypeIndex": "5",
    "Rank": "2",
    "Error": "-0.25",
    "PoseIndex": "17",
    "HandConfiguration": CONFIGURATION,
    "Image": "",
}


def write(path: Path, *changes: dict[str, str], encoding: str = "utf-8-sig") -> Path:
    rows = [ROW | {"Session": str(row + 1)} | change for row, change in enumerate(changes)]
    pd.DataFrame(rows).to_csv(path, index=False, encoding=encoding)
    return path


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
def test_reads_rows_with_and_without_a_configuration(tmp_path: Path, encoding: str) -> None:
    path = write(tmp_path / "table.csv", {}, {"HandConfiguration": ""}, encoding=encoding)
    table = read_published(path)
    assert list(table.columns[:6]) == [
        "index",
        "object",
        "task",
        "session",
        "grasp_type",
        "grasp_type_index",
    ]
    assert table.session.tolist() == [1, 2]
    assert table.energy.tolist() == [-0.25, -0.25]
    np.testing.assert_allclose(table.hand_configuration[0][-4:], [0.5, 1.0, 1.1, 1.2])
    assert table.hand_configuration[1] is None


def test_keeps_none_when_no_row_has_a_configuration(tmp_path: Path) -> None:
    table = read_published(write(tmp_path / "table.csv", {"HandConfiguration": " "}))
    assert table.hand_configuration[0] is None


@pytest.mark.parametrize(
    ("column", "cell", "said"),
    [
        ("Index", "", "not an integer"),
        ("Object", " ", "empty"),
        ("GraspTypeIndex", "8", "from 1 to 7"),
        ("Rank", "-", "not an integer"),
        ("Error", "much", "not a number"),
        ("PoseIndex", "1e3", "not an integer"),
        ("HandConfiguration", CONFIGURATION.replace("0.3", "x"), "'x' is not a number"),
        ("HandConfiguration", "0,-1" + CONFIGURATION[3:], "no valid rotation"),
        ("HandConfiguration", "0.5" + CONFIGURATION[1:], "rank index"),
    ],
)
def test_bad_cell_is_named_by_file_line_and_column(
    tmp_path: Path, column: str, cell: str, said: str
) -> None:
    path = write(tmp_path / "table.csv", {}, {column: cell})
    with pytest.raises(InputError) as caught:
        read_published(path)
    assert str(caught.value).startswith(f"{path}: line 3, {column}: ")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_published(tmp_path / "none.csv")


@pytest.mark.skipif(
    "GRASPTYPES_PUBLISHED_CSV" not in os.environ, reason="GRASPTYPES_PUBLISHED_CSV is not set"
)
def test_the_published_file_has_its_stated_counts() -> None:
    table = read_published(os.environ["GRASPTYPES_PUBLISHED_CSV"])
    assert len(table) == 713
    assert table.task.value_counts().to_dict() == {"handoff": 359, "use": 354}
    counts = table.grasp_type.value_counts()
    assert counts["Power Sphere"] == 197
    assert counts["Invalid"] == 19
    assert (table[table.grasp_type == "Invalid"].grasp_type_index != 7).sum() == 1
