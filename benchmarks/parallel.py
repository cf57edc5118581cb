"""How much of two cores a run with -j2 makes use of."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.figures import Figure, NotReady, figure, seconds

from grasptypes.versions.checkout import copy_checkout


def measure(settings: Mapping[str, Any], params: Mapping[str, Any]) -> Iterator[Figure]:
    """A slice of the workflow from nothing, with one job at a time and with two."""
    folder = Path(settings["folder"])
    shutil.rmtree(folder, ignore_errors=True)
    copy_checkout(".", folder, Path(__file__).with_name("slice.yaml"))
    works = [partial(_run, folder, jobs, settings["targets"]) for jobs in (1, 2)]
    taken_s = seconds(*works, rounds=settings["rounds"], warm_up=False)
    efficiency = np.median(taken_s[:, 0] / taken_s[:, 1]) / 2
    yield figure("parallel efficiency of -j2", efficiency, "", settings["aim"])


def _run(folder: Path, jobs: int, targets: list[str]) -> None:
    command = ["snakemake", f"-j{jobs}", "--forceall", *targets, "--quiet", "all"]
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if result.returncode:
        raise NotReady(f"{' '.join(command)}: {result.stderr.strip().splitlines()[-1]}")
