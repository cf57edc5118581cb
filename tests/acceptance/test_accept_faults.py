"""(h), (i): killed runs, two runs at once, and results edited by hand."""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

import pytest
from repository import Repository, jobs


@contextmanager
def running(repository: Repository, *command: str) -> Iterator[subprocess.Popen]:
    """A run in a session of its own, once its first job trains; killed at the end if it lives."""
    repository.set_param("predictors.epochs", 400)
    environment = repository.environment()
    log = repository.path.parent / "run.log"
    with log.open("w") as output:
        process = subprocess.Popen(
            command,
            cwd=repository.path,
            env=environment,
            stdout=output,
            stderr=output,
            start_new_session=True,
        )
    try:
        deadline = time.monotonic() + 60
        while "Training" not in log.read_text():
            assert process.poll() is None, log.read_text()
            assert time.monotonic() < deadline, log.read_text()
            time.sleep(0.2)
        yield process
    finally:
        kill(process)


def kill(process: subprocess.Popen) -> None:
    """Kill a run and its jobs, if they live."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


@pytest.mark.parametrize("command", [("snakemake", "-j2", "all"), ("dvc", "repro")], ids=" ".join)
def test_h_killed(changed: Repository, command: tuple[str, ...]) -> None:
    """(h) after kill -9 the next call just works"""
    with running(changed, *command) as process:
        kill(process)
    changed.set_param("predictors.epochs", 6)
    changed.run(*command)
    changed.dvc("repro")
    assert changed.is_clean()


def test_h_two_at_once(changed: Repository) -> None:
    """(h) a second call at the same time, of either tool, says who holds the lock"""
    with running(changed, "snakemake", "-j2", "all") as process:
        for command in (("snakemake", "-j2", "all"), ("dvc", "repro")):
            said = changed.run(*command, check=False)
            assert f"another run holds this folder: process {process.pid}" in said
            assert jobs(said) == {}
    with running(changed, "dvc", "repro"):
        said = changed.run("dvc", "repro", check=False)
        assert re.search(r"busy|Unable to acquire lock|another run", said), said
        assert re.search(r"PID \d+|process \d+", said), said


@pytest.mark.parametrize(
    ("edited", "by"),
    [
        ("data/grasps/mug/use.parquet", "data/grasps/mug/handoff.parquet"),
        ("data/samples.csv", "data/published_samples.csv"),
        ("reports/table1.csv", "reports/table2.csv"),
        ("models/simulated/no_task/predictor.safetensors", "params.yaml"),
    ],
)
def test_i_doctor(changed: Repository, edited: str, by: str) -> None:
    """(i) a hand-edited result is found by make doctor, with the command that mends it"""
    (changed.path / edited).write_bytes((changed.path / by).read_bytes())
    doctor = (sys.executable, "-m", "grasptypes.versions.doctor")
    source = str(changed.path / "src")
    found = changed.run(*doctor, check=False, PYTHONPATH=source)
    lines = [line for line in found.splitlines() if line.startswith(edited)]
    assert len(lines) == 1, found
    changed.run(*shlex.split(lines[0].split("mend it with: ")[1]))
    assert "nothing is wrong" in changed.run(*doctor, PYTHONPATH=source)
    assert changed.is_clean()
