"""Kill runs of the small configuration at random moments, start them again, and compare.

``python tests/workflow/kill_runs.py FOLDER --runs 20`` prints a line a run; the exit status is 1 if
a kill left a trace. ``--kills 4`` kills each run and its restarts four times in all. FOLDER keeps
the undisturbed run, which later calls compare with.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

from repository import TARGET, Repository
from verify import checksums

# Another target makes a short trial of this script itself.
RUN = ("snakemake", "-j2", os.environ.get("GRASPTYPES_KILL_TARGET", TARGET))
# What is noted for one target does not pass for another.
TRIAL = RUN[-1].replace("/", "_")
DYING_S = 5.0


def runs(root: Path) -> dict[str, int]:
    """What MLflow shows: runs and models by their state."""
    if not (root / "mlflow.db").exists():
        return {}
    with sqlite3.connect(root / "mlflow.db") as store:
        states = store.execute("select status, count(*) from runs group by status").fetchall()
        models = store.execute(
            "select status, count(*) from logged_models where lifecycle_stage = 'active' "
            "group by status"
        ).fetchall()
    found = {f"runs {status}": count for status, count in states}
    return found | {f"models {status}": count for status, count in models}


def processes_in(root: Path) -> list[int]:
    """Processes whose current folder is the repository."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if Path(os.readlink(entry / "cwd")) == root.resolve():
                found.append(int(entry.name))
        except OSError:  # gone, or somebody else's
            continue
    return found


def survivors(root: Path) -> list[int]:
    """Processes that a kill left alive; a killed one takes a moment to give its memory back."""
    deadline = time.monotonic() + DYING_S
    while (found := processes_in(root)) and time.monotonic() < deadline:
        time.sleep(0.1)
    return found


def undisturbed(folder: Path) -> tuple[Repository, float]:
    """The run that nobody killed, computed once, and how long it takes."""
    fresh, repository = Repository(folder / "fresh"), Repository(folder / f"undisturbed_{TRIAL}")
    noted = folder / f"seconds_{TRIAL}.json"
    if not noted.exists():
        for path in (fresh.path, repository.path):
            shutil.rmtree(path, ignore_errors=True)
        Repository.create(fresh.path).copy(repository.path)
        begun = time.monotonic()
        repository.run(*RUN)
        noted.write_text(json.dumps(time.monotonic() - begun))
    return repository, json.loads(noted.read_text())


def kill_after(repository: Repository, seconds: float) -> bool:
    """Start a run and kill its process group; returns whether it was still running."""
    with (repository.path / "killed.log").open("w") as log:
        process = subprocess.Popen(
            RUN,
            cwd=repository.path,
            env=repository.environment(),
            stdout=log,
            stderr=log,
            start_new_session=True,
        )
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return True
    return False


def faults(repository: Repository, expected: Repository) -> list[str]:
    """Start a killed run again; returns what is other than without the kill."""
    found = [f"process {number} lives on" for number in survivors(repository.path)]
    again = subprocess.run(
        RUN,
        cwd=repository.path,
        env=repository.environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    if again.returncode:
        found.append(f"the second run fails: {again.stderr[-1000:]}")
    ours, theirs = checksums(repository.path), checksums(expected.path)
    names = sorted({*ours, *theirs})
    found += [f"{name} differs" for name in names if ours.get(name) != theirs.get(name)]
    if runs(repository.path) != runs(expected.path):
        found.append(f"MLflow shows {runs(repository.path)} instead of {runs(expected.path)}")
    if not repository.snakemake_is_clean(RUN[-1]):
        found.append("a third run would not be for nothing")
    return found


def run_name(seed: int, number: int, kills: int) -> str:
    """Of what is noted about a run, and of its repository: all that decides when it is killed."""
    return f"run_{number}_seed_{seed}_kills_{kills}_{TRIAL}"


def disturb(folder: Path, seed: int, number: int, kills: int) -> list[str]:
    """Kill one run, and its restarts, that many times in all; prints when, and what came of it.

    What was done is noted, so that this script itself can be stopped and started again.
    """
    expected, whole_s = undisturbed(folder)
    draw = random.Random(f"{seed} {number}")
    # Moments of the whole run, or of its part that is left to each kill on average.
    moments_s = [draw.uniform(0, whole_s / kills) for _ in range(kills)]
    name = run_name(seed, number, kills)
    repository, noted = Repository(folder / name), folder / f"{name}.json"
    told = json.loads(noted.read_text()) if noted.exists() else []
    if isinstance(told, str):
        sys.stdout.write(told)
        return []
    while len(told) < kills:
        if not repository.path.exists():
            Repository(folder / "fresh").copy(repository.path)
        if kill_after(repository, moments_s[len(told)]):
            there = len(checksums(repository.path))
            told.append(f"{moments_s[len(told)]:.1f} s ({there} files)")
        else:  # today the machine is faster: once more from nothing, and sooner
            told, moments_s = [], [0.8 * moment for moment in moments_s]
            shutil.rmtree(repository.path)
        noted.write_text(json.dumps(told))
    found = faults(repository, expected)
    files = len(checksums(expected.path))
    line = f"run {number} of {whole_s:.0f} s and {files} files, killed after {', '.join(told)}: "
    line += ("; ".join(found) or "no trace") + "\n"
    sys.stdout.write(line)
    sys.stdout.flush()
    if not found:
        shutil.rmtree(repository.path)
        noted.write_text(json.dumps(line))
    return found


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--kills", type=int, default=1, help="of each run")
    parser.add_argument("--first", type=int, default=0, help="number of the first run")
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    folder = asked.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    numbers = range(asked.first, asked.first + asked.runs)
    bad = [number for number in numbers if disturb(folder, asked.seed, number, asked.kills)]
    sys.stdout.write(
        f"{(len(numbers) - len(bad)) * asked.kills} of {len(numbers) * asked.kills} kills "
        "left no trace\n"
    )
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
