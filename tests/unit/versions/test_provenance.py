"""Records that travel with the results: a real Snakemake, and results from elsewhere."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from grasptypes.errors import InputError
from grasptypes.versions.provenance import (
    ADOPTED,
    PROVENANCE,
    adopt_provenance,
    times_ms,
    write_provenance,
)

SNAKEFILE = """
rule both:
    input: "data/first.csv", "source.csv"
    output: "data/second.csv", "elsewhere.csv"
    params: 2
    shell: "cat {input} > data/second.csv; touch elsewhere.csv"

rule first:
    output: "data/first.csv"
    params: 1
    shell: "echo one > {output}"
"""
OUTS = "[data/first.csv, data/second.csv: {persist: true}, data/provenance.json]"


def snakemake(folder: Path) -> str:
    command = [sys.executable, "-m", "snakemake", "-j1", "--rerun-triggers", "params", "mtime"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return done.stderr


def made(folder: Path, sleep: str = "") -> Path:
    """A folder with computed results and their provenance."""
    folder.mkdir()
    (folder / "Snakefile").write_text(SNAKEFILE.replace("echo", f"{sleep} echo"))
    (folder / "dvc.yaml").write_text(f"stages: {{a: {{outs: {OUTS}}}}}")
    (folder / "source.csv").write_text("source\n")
    snakemake(folder)
    write_provenance(folder)
    return folder


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """A folder that got the results from elsewhere, the inputs newer than what was made of them."""
    origin, clone = made(tmp_path / "origin"), tmp_path / "clone"
    clone.mkdir()
    (clone / "data").mkdir()
    names = ("Snakefile", "dvc.yaml", "data/second.csv", "elsewhere.csv", PROVENANCE)
    for name in (*names, "data/first.csv", "source.csv"):
        (clone / name).write_bytes((origin / name).read_bytes())
    return clone


def test_it_depends_on_the_results_alone(tmp_path: Path) -> None:
    one, two = (made(tmp_path / name) for name in ("one", "two"))
    assert (one / PROVENANCE).read_bytes() == (two / PROVENANCE).read_bytes()
    jobs = json.loads((one / PROVENANCE).read_text())
    assert [list(job["outputs"]) for job in jobs] == [["data/first.csv"], ["data/second.csv"]]
    assert not {"starttime", "endtime", "job_hash"} & jobs[0].keys()


def test_what_was_adopted_is_not_made_again_until_something_changes(clone: Path) -> None:
    adopt_provenance(clone)
    (clone / "elsewhere.csv").touch()
    assert "rule first" not in snakemake(clone)
    (clone / "Snakefile").write_text(SNAKEFILE.replace("params: 1", "params: 3"))
    assert "Params have changed" in snakemake(clone)


def test_a_result_that_was_made_anew_keeps_its_own_record(clone: Path) -> None:
    adopt_provenance(clone)
    (clone / "Snakefile").write_text(SNAKEFILE.replace("params: 1", "params: 3"))
    snakemake(clone)  # the same bytes with other parameters
    adopt_provenance(clone)
    assert "Nothing to be done" in snakemake(clone)


def test_a_file_that_is_another_gets_no_record(clone: Path) -> None:
    (clone / "data/first.csv").write_text("edited\n")
    adopt_provenance(clone)
    stamp = int(1000 * (clone / "data/first.csv").stat().st_mtime)
    assert times_ms(Path("data/first.csv"), clone) == (stamp, stamp)
    assert not list((clone / ".snakemake/metadata").glob("ZGF0YS9maXJzdC5jc3Y=*"))


def test_a_damaged_provenance_is_named_with_the_cure(clone: Path) -> None:
    (clone / PROVENANCE).write_text('[{"rule": ')
    with pytest.raises(InputError, match=r"provenance\.json: is damaged; restore it with: dvc"):
        adopt_provenance(clone)
    assert not (clone / ADOPTED).exists()


def test_a_job_tells_when_it_began_and_ended(tmp_path: Path) -> None:
    root = made(tmp_path / "made", "sleep 0.5;")
    begun, ended = times_ms(Path("data/first.csv"), root)
    assert 400 < ended - begun < 5000
