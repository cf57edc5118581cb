"""What counts as made: a real Snakemake, and results some of which came without records."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from snakemake.persistence.file import FilePersistence

from grasptypes.versions.job_records import RECORDS, is_recorded, record_path, recorded_result

SNAKEFILE = """
from snakemake.persistence import PersistenceBase
from grasptypes.versions.job_records import distrust_unrecorded

distrust_unrecorded(PersistenceBase)

rule table:
    input: "middle.csv", "kept.csv"
    output: "table.csv"
    shell: "cat {input} > {output}"

rule middle:
    output: "middle.csv"
    shell: "echo middle > {output}"

rule kept:
    output: update("kept.csv")
    shell: "echo made >> {output}"
"""


def snakemake(folder: Path, *arguments: str) -> str:
    command = [sys.executable, "-m", "snakemake", "-j1", "table.csv", "--rerun-incomplete"]
    result = subprocess.run(
        [*command, *arguments], cwd=folder, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stderr
    return result.stderr


@pytest.fixture
def clone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A workflow whose results lie there, as git brings them: no record of any."""
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[3] / "src"))
    (tmp_path / "Snakefile").write_text(SNAKEFILE)
    for name in ("kept.csv", "middle.csv", "table.csv"):
        (tmp_path / name).write_text("from git\n")
    return tmp_path


def test_results_without_a_record_are_made_anew_and_then_stay(clone: Path) -> None:
    snakemake(clone)
    assert (clone / "table.csv").read_text() == "middle\nfrom git\n"
    assert "Nothing to be done" in snakemake(clone)


def test_after_a_broken_off_run_the_rest_is_made(clone: Path) -> None:
    snakemake(clone, "--until", "middle")
    assert (clone / "middle.csv").read_text() == "middle\n"
    assert (clone / "table.csv").read_text() == "from git\n"
    output = snakemake(clone)
    assert (clone / "table.csv").read_text() == "middle\nfrom git\n"
    assert "rule middle" not in output


@pytest.mark.parametrize("result", ["data/backbone.json", "data/" + 300 * "x" + ".csv"])
def test_records_lie_where_snakemake_keeps_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, result: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert not is_recorded(result)
    record = record_path(result)
    store = SimpleNamespace(_fetch_max_len=lambda _: 255)
    assert str(record) == FilePersistence._record_path(store, RECORDS, result)
    record.parent.mkdir(parents=True, exist_ok=True)
    record.touch()
    assert is_recorded(result)
    assert recorded_result(record.relative_to(RECORDS)) == result
