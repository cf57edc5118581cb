"""Faults of the machine: the run reports them in one line, and nothing is lost."""

from __future__ import annotations

import re
import shutil
import sqlite3
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from repository import TARGET, Repository
from verify import checksums

pytestmark = pytest.mark.slow
OBJECT = "data/objects/mug"
# A lost intermediate result is only recomputed if it is requested.
RUN = ("snakemake", "-j2", "objects", "renders", "predictors", TARGET)


def is_whole(repository: Repository, complete: Repository) -> bool:
    """Whether another run makes everything as it would have been."""
    repository.run(*RUN)
    return checksums(repository.path) == checksums(complete.path)


@pytest.mark.parametrize("free_kb", [0, 300, 1500])
def test_a_full_disk(
    complete: Repository, tmp_path: Path, mount: Callable[..., None], free_kb: int
) -> None:
    disk = tmp_path / "disk"
    disk.mkdir()
    mount("-t", "tmpfs", "-o", "size=1g", "tmpfs", str(disk))
    repository = complete.copy(disk / "repository")
    repository.lose(OBJECT)
    used_kb = shutil.disk_usage(disk).used // 1024
    mount("-o", f"remount,size={used_kb + free_kb}k", str(disk))
    output = repository.run(*RUN, check=False)
    assert re.search(r"error: \S+: .*No space left on device", output)
    assert "Traceback" not in output
    assert not (repository.path / OBJECT / "visual.glb").exists()
    mount("-o", "remount,size=1g", str(disk))
    assert is_whole(repository, complete)


def test_a_folder_that_is_read_only(
    changed: Repository, complete: Repository, mount: Callable[..., None]
) -> None:
    changed.lose(OBJECT)
    place = str(changed.path)
    mount("--bind", place, place)
    mount("-o", "remount,ro,bind", place)
    output = changed.run(*RUN, check=False)
    assert re.search(r"error: \S+: .*Read-only file system", output)
    assert "Traceback" not in output
    subprocess.run(["umount", place], check=True)
    assert is_whole(changed, complete)


def runs(repository: Repository) -> list[tuple[str, int]]:
    """What MLflow shows: runs and models by their state."""
    query = "select status, count(*) from {} group by status"
    with sqlite3.connect(repository.path / "mlflow.db") as store:
        return [
            row
            for table in ("runs", "logged_models where lifecycle_stage = 'active'")
            for row in store.execute(query.format(table)).fetchall()
        ]


def test_a_store_of_runs_that_is_locked(changed: Repository, complete: Repository) -> None:
    changed.set_param("tracking.patience_s", 1)
    changed.lose("mlflow.db", "mlruns", "reports/metrics/simulated/no_task.csv")
    with sqlite3.connect(changed.path / "mlflow.db", isolation_level=None) as held:
        held.execute("BEGIN EXCLUSIVE")
        output = changed.run("snakemake", "-j2", check=False)
        held.execute("ROLLBACK")
    assert "error: publish_runs: " in output
    assert "mlflow.db: cannot be written: database is locked" in output
    made = checksums(changed.path)
    assert made == {name: text for name, text in checksums(complete.path).items() if name in made}
    assert changed.snakemake_is_clean("results")
    changed.snakemake("all")
    assert runs(changed) == runs(complete)
    assert changed.snakemake_is_clean("all")


def test_a_gl_library_that_is_missing(changed: Repository, complete: Repository) -> None:
    changed.lose("data/renders/mug.*")
    # Hidden from this run alone, in a mount namespace of its own.
    hide = 'for file in $HIDDEN; do mount --bind /dev/null "$file" || exit 9; done; exec "$@"'
    known = subprocess.run(["ldconfig", "-p"], capture_output=True, text=True, check=True).stdout
    names = ("libEGL.so.1", "libOSMesa.so.8")
    hidden = " ".join(
        line.rpartition("=> ")[2] for line in known.splitlines() if line.split()[0] in names
    )
    output = changed.run(
        "unshare", "-m", "bash", "-c", hide, "bash", *RUN, check=False, HIDDEN=hidden
    )
    if "mount: " in output:
        pytest.skip(f"cannot mount here: {output.splitlines()[0]}")
    line = "error: PYOPENGL_PLATFORM: no off-screen OpenGL here; install it: apt-get install"
    assert line in output
    assert "Traceback" not in output
    assert is_whole(changed, complete)


def test_memory_too_short_for_one_job(changed: Repository, complete: Repository) -> None:
    spacing_m = 0.002
    assert "grid_spacing_m: 0.002" in (changed.path / "params.yaml").read_text()
    changed.set_param("objects.resolution.grid_spacing_m", spacing_m / 4)
    changed.lose(OBJECT)
    output = changed.run("prlimit", f"--as={2**30}", *RUN, check=False)
    assert "error: not enough memory for this job" in output
    assert "Traceback" not in output
    changed.set_param("objects.resolution.grid_spacing_m", spacing_m)
    assert is_whole(changed, complete)
