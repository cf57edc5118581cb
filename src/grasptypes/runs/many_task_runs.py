"""Models that are told one of many tasks in MLflow: a parent run for each number, a run a fold."""

from __future__ import annotations

import json
from collections.abc import Mapping

import pandas as pd

from grasptypes.predictors.many_task_tables import mean_of_pairs
from grasptypes.runs.tracking import RunRecord, run_key


def many_task_records(
    trials: pd.DataFrame,
    settings: Mapping[str, object],
    times_ms: tuple[int, int],
    tags: Mapping[str, str],
) -> list[RunRecord]:
    """The parent runs of one model: one per number of tasks, and one for tasks left out.

    Args:
        trials: of :data:`grasptypes.predictors.many_task_tables.TRIAL_SCHEMA`.
        settings: that the heads were trained with, and of the study.
        times_ms: start and end of the job, milliseconds since 1970.
        tags: the hand, and what is not part of the result.
    """
    flat = pd.json_normalize(dict(settings)).to_dict("records")[0]
    records = []
    for (split, number), table in trials.groupby(["split", "tasks"], sort=False):
        model = table["model"].iloc[0]
        known = {"labels": "simulated", "model": model, "split": split, "tasks": number}
        stated = {"hand": tags["hand"], **flat, **known}
        params = {name: str(value) for name, value in stated.items()}
        key = run_key(table.to_csv(index=False), json.dumps(params, sort_keys=True))
        runs = mean_of_pairs(table)
        children = [
            RunRecord(
                key=run_key(key, str(group), str(seed)),
                name=f"{'fold' if split == 'views' else 'without'} {group}, seed {seed}",
                times_ms=times_ms,
                params={**params, "fold": str(group), "seed_number": str(seed)},
                metrics={name: float(value) for name, value in row.items()},
                curves={},
                tags=tags,
            )
            for (group, seed), row in runs.iterrows()
        ]
        means = {name: float(value) for name, value in runs.mean().items()}
        what = f"{number} tasks" if split == "views" else f"each of {number} tasks left out"
        name = f"simulated {model}, {what}"
        records.append(RunRecord(key, name, times_ms, params, means, {}, tags, children))
    return records
