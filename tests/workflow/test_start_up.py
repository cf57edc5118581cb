"""What Snakemake says before it runs anything."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from repository import ROOT, Repository

from grasptypes.predictors.weights import WEIGHTS_VARIABLE
from grasptypes.versions.guard import FolderLock


def test_the_main_job_is_complete_and_small(fresh: Repository) -> None:
    planned = fresh.planned("reports/table1.csv")
    assert planned["prepare_object"] == 2
    assert planned["map_contacts"] == 4
    assert planned["synthesize_grasps"] == 4
    assert planned["train_predictor"] == 4


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("objects.names", ["mug", "teapot"], "params.yaml: objects.names.1: 'teapot'"),
        ("objects.scale", "big", "params.yaml: objects.scale: 'big' is not of type 'number'"),
        ("seed", 0.5, "params.yaml: seed: 0.5 is not of type 'integer'"),
    ],
)
def test_bad_params_end_with_one_line(
    repository: Repository, key: str, value: object, expected: str
) -> None:
    repository.set_param(key, value)
    output = repository.run("snakemake", "-n", check=False)
    lines = [line for line in output.splitlines() if "profile" not in line]
    assert len(lines) == 1, output
    assert lines[0].startswith(f"error: {expected}")
    assert not (repository.path / "data").exists()


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("", "must hold a mapping"),
        ("seed: [1\n", "line 2: not valid YAML"),
        ("__use_yte__: true\n?open('ran', 'w'): 1\n", "'__use_yte__' were unexpected"),
    ],
)
def test_a_file_that_is_no_params_never_reaches_snakemake(
    repository: Repository, content: str, expected: str
) -> None:
    (repository.path / "params.yaml").write_text(content)
    output = repository.run("snakemake", "-n", check=False)
    lines = [line for line in output.splitlines() if "profile" not in line]
    assert len(lines) == 1, output
    assert lines[0].startswith("error: params.yaml: ")
    assert expected in lines[0]
    assert not (repository.path / "ran").exists()


@pytest.mark.parametrize("library", ["torch", "mlflow", "trimesh", "matplotlib"])
def test_a_dry_run_imports_nothing_that_takes_seconds(
    fresh: Repository, tmp_path: Path, library: str
) -> None:
    (tmp_path / f"{library}.py").write_text("raise SystemExit('imported at the start')\n")
    output = fresh.run("snakemake", "-n", PYTHONPATH=str(tmp_path))
    assert "Job stats" in output


@pytest.mark.parametrize("content", ["", "<<<<<<< HEAD\n", "[]", "{}"])
def test_a_damaged_record_of_the_backbone_is_made_anew(
    repository: Repository, monkeypatch: pytest.MonkeyPatch, content: str
) -> None:
    monkeypatch.delenv(WEIGHTS_VARIABLE, raising=False)
    record = Path("data/backbone.json")
    (repository.path / record).parent.mkdir(parents=True, exist_ok=True)
    (repository.path / record).write_text(content)
    assert repository.planned()["prepare_backbone"] == 1


def test_a_cache_of_links_is_refused(repository: Repository) -> None:
    repository.dvc("config", "cache.type", "hardlink")
    output = repository.run("snakemake", "-n", check=False)
    assert "error: " in output
    assert "dvc config cache.type reflink,copy" in output


def test_jobs_start_only_for_who_holds_the_folder(repository: Repository) -> None:
    """Whoever else reads the workflow meanwhile leaves alone what a run has at work."""
    target = "data/objects/mug/visual.glb"
    mine = [".snakemake/locks/0.output.lock", "data/objects/mug/.live.1.tmp"]
    for path in (repository.path / name for name in mine):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("data/objects/banana/visual.glb")
    lock = FolderLock(repository.path / ".snakemake")
    assert lock.take()
    message = f"another run holds this folder: process {os.getpid()}"
    assert message in repository.run("snakemake", "-n", target)
    assert all((repository.path / name).exists() for name in mine)
    assert message in repository.run("snakemake", "-j1", target, check=False)
    assert not (repository.path / target).exists()
    assert (repository.path / mine[1]).exists()  # Snakemake itself drops all of its own locks
    del lock
    repository.run("snakemake", "-n", target)
    assert not any((repository.path / name).exists() for name in mine)


def test_scans_are_inputs_of_the_table_that_is_measured_with_them(
    repository: Repository, tmp_path: Path
) -> None:
    scan = tmp_path / "scans" / "mug.stl"
    scan.parent.mkdir()
    scan.touch()
    named = {"GRASPTYPES_REFERENCE_MESHES": str(scan.parent)}
    assert str(scan) in repository.run("snakemake", "compare_shapes", "--filegraph", **named)


def tool(name: str) -> str:
    path = shutil.which(name, path=str(Path(sys.executable).parent))
    assert path is not None, f"{name} is not installed"
    return path


def test_workflow_is_linted_and_formatted() -> None:
    for command in (
        [tool("snakemake"), "--lint"],
        [tool("snakefmt"), "--check", "Snakefile", "workflow"],
    ):
        result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        assert result.returncode == 0, result.stdout + result.stderr


def test_every_rule_that_runs_a_script_hashes_that_script() -> None:
    rules = "\n".join(path.read_text() for path in sorted((ROOT / "workflow/rules").glob("*.smk")))
    for script in sorted((ROOT / "workflow/scripts").glob("*.py")):
        assert f'"../scripts/{script.name}"' in rules, f"no rule runs {script.name}"
        assert f'script_hash("{script.stem}")' in rules, f"{script.name} is not hashed"
