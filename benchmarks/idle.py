"""Seconds that Snakemake and DVC take to find that there is nothing to do."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from benchmarks.figures import Figure, NotReady, figure, seconds

from grasptypes.settings.params import Params

COMMANDS = {
    "Snakemake": (("snakemake", "-j2"), ("snakemake", "-n"), "Nothing to be done"),
    "DVC": (("dvc", "repro"), ("dvc", "status"), "up to date"),
}


def measure(settings: Mapping[str, Any], params: Params) -> Iterator[Figure]:
    """Only measured if there is nothing to do: no benchmark starts an hour of work."""
    for tool, (command, question, answer) in COMMANDS.items():
        if answer not in _run(question):
            raise NotReady(f"{tool} has work to do: dvc repro")
        taken_s = seconds(partial(_run, command), rounds=settings["rounds"])
        median_s = float(np.median(taken_s))
        yield figure(f"{tool} with nothing to do", median_s, "s", settings["aim_s"])


def _run(command: Sequence[str]) -> str:
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    return result.stdout + result.stderr
