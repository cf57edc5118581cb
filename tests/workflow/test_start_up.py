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


@pytest.mark.parametrize("library", ["torch", "mlflow", "trimesh", "matplotlib"])
def test_a_dry_run_imports_nothing_that_takes_seconds(
    fresh: Repository, tmp_path: Path, library: str
) -> None:
    (tmp_path / f"{library}.py").write_text("raise SystemExit('imported at the start')\n")
    assert "Job stats" in fresh.run("snakemake", "-n", PYTHONPATH=str(tmp_path))


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


@pytest.mark.parametrize(
    ("statement", "reason"),
    [
        ("raise InputError('mesh.stl', 'faces', 'are missing')", "mesh.stl: faces: are missing"),
        ("raise KeyError('mug')", "KeyError: 'mug'"),
        ("raise OSError(28, 'No space left on device', 'a.npz')", "a.npz: No space left on device"),
        ("raise MemoryError", "not enough memory for this job"),
        ("sys.exit(3)", "ended without a message"),
        ("os.kill(os.getpid(), 9)", "ended without a message, as if killed"),
    ],
)
def test_a_job_that_fails_ends_with_its_reason(
    repository: Repository, statement: str, reason: str
) -> None:
    script = repository.path / "workflow/scripts/prepare_object.py"
    text = script.read_text()
    main = text.index("    with job(snakemake.log)")
    imports = "    import os, sys\n    from grasptypes.errors import InputError\n"
    script.write_text(f"{text[:main]}{imports}    with job(snakemake.log):\n        {statement}\n")
    output = repository.run("snakemake", "-j1", OBJECT, check=False)
    assert f"\nerror: prepare_object/mug: {reason}" in output
    assert output.index(f"error: prepare_object/mug: {reason}") > output.index("Error in rule")


def test_workflow_is_linted_and_every_script_is_hashed() -> None:
    command = [sys.executable, "-m", "snakemake", "--lint"]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    rules = "\n".join(path.read_text() for path in sorted((ROOT / "workflow/rules").glob("*.smk")))
    for script in sorted((ROOT / "workflow/scripts").glob("*.py")):
        assert f'"../scripts/{script.name}"' in rules, f"no rule runs {script.name}"
        assert f'script_hash("{script.stem}")' in rules, f"{script.name} is not hashed"
