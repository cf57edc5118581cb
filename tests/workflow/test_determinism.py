"""The same bytes whatever the number of jobs."""

import subprocess
import sys
from pathlib import Path

import pytest
from repository import ROOT, SMALL, Repository
from verify import checksums

# Objects, contact maps, grasps, labels, pictures, features, folds and one model.
TARGET = "reports/metrics/simulated/task_vector.csv"


def test_one_job_at_a_time_makes_the_same_files(
    complete: Repository, repository: Repository
) -> None:
    repository.run("snakemake", "-j1", TARGET)
    made, expected = checksums(repository.path), checksums(complete.path)
    assert {name: expected.get(name) for name in made} == made
    kinds = {Path(name).parts[1] for name in made if name.startswith("data/")}
    assert {"objects", "contact_maps", "grasps", "renders", "features"} <= kinds


@pytest.mark.slow
def test_everything_twice_from_nothing(tmp_path: Path) -> None:
    script = Path(__file__).with_name("verify.py")
    command = [sys.executable, str(script), str(tmp_path / "verify"), "--params", str(SMALL)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    assert "differs" not in done.stdout
