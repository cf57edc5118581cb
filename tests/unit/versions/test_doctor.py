"""Results that are not what dvc.lock names: edited by hand, or computed since."""

import json
import os
from pathlib import Path

import pytest

from grasptypes.versions.doctor import changed_files, is_edited
from grasptypes.versions.job_records import RECORDS, record_path

STATUS = {
    "grasps": [{"changed outs": {"data/grasps": "modified", "data/grasps.csv": "modified"}}],
    "renders": [
        {"changed deps": {"src": "modified"}},
        {"changed outs": {"data/renders": "modified"}},
    ],
    "reports": ["changed command", {"changed outs": {"reports/table1.csv": "modified"}}],
    "models": [{"changed outs": {"models": "deleted"}}],
}
DATA_STATUS = {
    "uncommitted": {
        "modified": ["data/grasps/", "data/grasps/mug/use.parquet", "data/renders/mug.zip"]
    }
}


def test_only_results_that_changed_alone_count_and_folders_are_opened() -> None:
    assert changed_files(STATUS, DATA_STATUS) == ["data/grasps.csv", "data/grasps/mug/use.parquet"]


def test_a_clean_repository_has_none() -> None:
    assert changed_files({}, {}) == []


@pytest.fixture
def table(tmp_path: Path) -> str:
    """A table with Snakemake's record of it."""
    (tmp_path / "table.csv").write_text("a,b\n")
    record = tmp_path / record_path("table.csv")
    record.parent.mkdir(parents=True)
    record.write_text(json.dumps({"endtime": (tmp_path / "table.csv").stat().st_mtime}))
    return "table.csv"


def test_what_a_job_made_is_not_edited(table: str, tmp_path: Path) -> None:
    assert not is_edited(table, tmp_path)
    assert not is_edited(f"{RECORDS}/", tmp_path)


def test_what_was_written_after_its_job_is_edited(table: str, tmp_path: Path) -> None:
    made = (tmp_path / table).stat().st_mtime
    os.utime(tmp_path / table, (made + 1, made + 1))
    assert is_edited(table, tmp_path)


def test_what_no_job_made_is_edited(table: str, tmp_path: Path) -> None:
    (tmp_path / record_path(table)).unlink()
    assert is_edited(table, tmp_path)
