"""How well a run with -j2 uses two cores."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.figures import Figure, NotReady, figure, seconds

from grasptypes.settings.params import Params
from grasptypes.versions.checkout import copy_checkout


def measure(settings: Mapping[str, Any], params: Params) -> Iterator[Figure]:
    """A slice of the workflow from nothing: one job at a time, two, and twice at once.

    Two independent runs show how much the machine's cores slow each other down.
    """
    folder = Path(settings["folder"])
    shutil.rmtree(folder, ignore_errors=True)
    places = [folder / name for name in ("one", "other")]
    for place in places:
        copy_checkout(".", place, Path(__file__).with_name("slice.yaml"))
        _run(settings["warm_up"], 1, place)
    run = partial(_run, settings["targets"])
    works = [partial(run, 1, places[0]), partial(run, 2, places[0]), partial(_at_once, run, places)]
    taken_s = seconds(*works, rounds=settings["rounds"], warm_up=False)
    one, two, at_once = np.median(taken_s, axis=0)
    yield figure("efficiency of two runs with -j1 at once", one / at_once, "", 1.0)
    yield figure("parallel efficiency of -j2", one / two / 2, "", settings["aim"])


def _at_once(run: Callable[[int, Path], None], places: Sequence[Path]) -> None:
    with ThreadPoolExecutor(len(places)) as pool:
        list(pool.map(partial(run, 1), places))


def _run(targets: Sequence[str], jobs: int, folder: Path) -> None:
    command = ["snakemake", f"-j{jobs}", "--forceall", *targets, "--quiet", "all"]
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if result.returncode:
        raise NotReady(f"{' '.join(command)}: {result.stderr.strip().splitlines()[-1]}")
