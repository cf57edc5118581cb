"""What Snakemake reports before it runs anything, and how a failing run ends."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from repository import ROOT, TARGET, Repository

from grasptypes.versions.guard import FolderLock

OBJECT = "data/objects/mug/visual.glb"


def test_the_main_job_is_complete_and_small(fresh: Repository) -> None:
    planned = fresh.planned(TARGET)
    assert planned["prepare_object"] == 2
    assert planned["map_contacts"] == planned["synthesize_grasps"] == 4
    assert planned["train_predictor"] == 5
    assert planned["publish_runs"] == 0


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("- mug", "- teapot", "objects.names.1: 'teapot'"),
        ("seed: 0", "seed: 0.5", "seed: 0.5"),
        ("seed: 0", "seed: [1", "not valid YAML"),
        ("seed: 0", "seed: 0\n__use_yte__: true\n?open('ran', 'w'): 1", "__use_yte__"),
    ],
)
def test_bad_params_end_with_one_line_and_are_never_run(
    repository: Repository, old: str, new: str, expected: str
) -> None:
    path = repository.path / "params.yaml"
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    output = repository.run("snakemake", "-n", check=False)
    lines = [line for line in output.splitlines() if "profile" not in line]
    assert len(lines) == 1, output
    assert lines[0].startswith("error: params.yaml: ")
    assert expected in lines[0]
    assert not (repository.path / "data").exists()
    assert not (repository.path / "ran").exists()


def test_a_dry_run_imports_nothing_that_takes_seconds(fresh: Repository, tmp_path: Path) -> None:
    for library in ("torch", "mlflow", "trimesh", "matplotlib"):
        text = f"raise SystemExit('{library} is imported at the start')\n"
        (tmp_path / f"{library}.py").write_text(text)
    assert "Job stats" in fresh.run("snakemake", "-n", PYTHONPATH=str(tmp_path))


def test_studies_beside_the_main_job_have_a_job_for_what_objects_afford(
    repository: Repository,
) -> None:
    """A banana is put away; a mug is also washed, and poured from."""
    planned = repository.planned("many_tasks", "demonstrations", "reports/learning_curve.csv")
    assert planned["synthesize_further_grasps"] == planned["map_further_contacts"] == 4
    assert planned["extract_shifted_features"] == planned["demonstrate_further_tasks"] == 2
    assert planned["learn_many_tasks"] == 7
    assert planned["demonstrate_grasps_alone"] == planned["demonstrate_tasks"] == 2
    assert planned["learn_from_fewer_views"] == 3
    assert "synthesize_further_grasps" not in repository.planned()


def test_jobs_start_only_for_who_holds_the_folder(repository: Repository) -> None:
    """Another process that reads the workflow does not disturb a run."""
    half = repository.path / "data/objects/mug/.live.1.tmp"
    half.parent.mkdir(parents=True)
    half.touch()
    lock = FolderLock(repository.path / ".snakemake")
    assert lock.take()
    message = f"another run is active in this folder: process {os.getpid()}"
    assert message in repository.run("snakemake", "-n", OBJECT)
    assert message in repository.run("snakemake", "-j1", OBJECT, check=False)
    assert half.exists()
    assert not (repository.path / OBJECT).exists()
    del lock
    repository.run("snakemake", "-n", OBJECT)
    assert not half.exists()


# What the job of an object does, and what is said of it.
FAILURES = {
    "apple": ("raise KeyError('mug')", "KeyError: 'mug'"),
    "banana": (
        "raise InputError('mesh.stl', 'faces', 'are missing')",
        "mesh.stl: faces: are missing",
    ),
    "bowl": (
        "raise OSError(28, 'No space left on device', 'a.npz')",
        "a.npz: No space left on device",
    ),
    "cup": ("raise MemoryError", "not enough memory for this job"),
    "knife": ("sys.exit(3)", "ended without a message"),
    "mug": ("os.kill(os.getpid(), 9)", "ended without a message, as if killed"),
}
FAILING = """
import os, sys
from grasptypes.errors import InputError
from grasptypes.jobs import job
with job(snakemake.log):
    exec({statements}[snakemake.wildcards.object])
"""


def test_jobs_that_fail_end_with_their_reasons(repository: Repository) -> None:
    repository.set_param("objects.names", [*FAILURES])
    statements = {name: statement for name, (statement, _) in FAILURES.items()}
    script = repository.path / "workflow/scripts/prepare_object.py"
    script.write_text(FAILING.format(statements=statements))
    output = repository.run("snakemake", "-j2", "objects", check=False)
    summary = output[output.rindex("Error in rule") :]
    for name, (_, reason) in FAILURES.items():
        assert f"\nerror: prepare_object/{name}: {reason}" in summary


def test_workflow_is_linted_and_every_script_is_hashed() -> None:
    command = [sys.executable, "-m", "snakemake", "--lint"]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    rules = "\n".join(path.read_text() for path in sorted((ROOT / "workflow/rules").glob("*.smk")))
    for script in sorted((ROOT / "workflow/scripts").glob("*.py")):
        assert f'"../scripts/{script.name}"' in rules, f"no rule runs {script.name}"
        assert f'script_hash("{script.stem}")' in rules, f"{script.name} is not hashed"
