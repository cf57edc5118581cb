"""Seconds to train one model, all folds and seeds in parallel, compared with one by one."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import torch
from benchmarks.figures import Figure, seconds

from grasptypes.predictors.members import members_by_group
from grasptypes.predictors.problem import read_problem
from grasptypes.predictors.training import fit
from grasptypes.settings.params import Params


def measure(settings: Mapping[str, Any], params: Params) -> Iterator[Figure]:
    """One thread, as in the workflow; one member represents those trained one by one."""
    torch.set_num_threads(1)
    name = settings["labels"], settings["model"]
    samples = "samples" if settings["labels"] == "simulated" else "published_samples"
    files = {
        "inputs": sorted(Path("data/features").glob("*.npz")),
        "samples": Path("data") / f"{samples}.csv",
        "folds": Path("data/folds.csv"),
        "backbone": Path("data/backbone.json"),
    }
    problem = read_problem(files, name, params.colour_shifts, params.predictors)
    members = members_by_group(problem.examples.index["fold"], params.predictors.seeds)
    train = partial(fit, problem.examples, settings=problem.settings, key=("benchmark",))
    works = partial(train, members), partial(train, members[:1])
    clock, rounds = time.process_time, settings["rounds"]
    together_s, alone_s = seconds(*works, rounds=rounds, warm_up=False, clock=clock).T
    in_turn_s = len(members) * alone_s
    yield Figure(
        f"training of {settings['model']}, {len(members)} heads",
        float(np.median(together_s)),
        "s",
        float(np.median(in_turn_s)),
        float(np.median(together_s / in_turn_s)),
    )
