"""The model that is shown the task in MLflow: a parent run for each split, a run for each fold."""

from __future__ import annotations

import json
from collections.abc import Mapping

import pandas as pd

from grasptypes.predictors.metrics import METRICS
from grasptypes.runs.tracking import RunRecord, run_key


def demonstration_records(
    trials: pd.DataFrame,
    settings: Mapping[str, object],
    times_ms: tuple[int, int],
    tags: Mapping[str, str],
) -> list[RunRecord]:
    """The parent runs of one label source.

    The measures that all runs of the project have are those with the right demonstration; the
    others have the name of what the demonstration tells before them.

    Args:
        trials: of :data:`grasptypes.predictors.demonstrations.TRIAL_SCHEMA`.
        settings: that the heads were trained with, and the demonstrations made.
        times_ms: start and end of the job, milliseconds since 1970.
        tags: the hand, and what is not part of the result.
    """
    flat = pd.json_normalize(dict(settings)).to_dict("records")[0]
    records = []
    for _, table in trials.groupby("split", sort=False):
        fixed = ["labels", "model", "split", "backbone", "weights", "finetune"]
        stated = {"hand": tags["hand"], **flat, **table.iloc[0][fixed]}
        params = {name: str(value) for name, value in stated.items()}
        key = run_key(table.to_csv(index=False), json.dumps(params, sort_keys=True))
        children = [
            RunRecord(
                key=run_key(key, str(fold), str(seed)),
                name=f"fold {fold}, seed {seed}",
                times_ms=times_ms,
                params={**params, "fold": str(fold), "seed_number": str(seed)},
                metrics=_measures(own),
                curves={},
                tags=tags,
            )
            for (fold, seed), own in table.groupby(["group", "seed"])
        ]
        name = f"{params['labels']} {params['model']}, new {params['split']}"
        records.append(RunRecord(key, name, times_ms, params, _measures(table), {}, tags, children))
    return records


def _measures(trials: pd.DataFrame) -> dict[str, float]:
    means = trials.groupby("told")[list(METRICS)].mean()
    found = {name: float(means.loc["right", name]) for name in METRICS}
    for told, row in means.drop("right").iterrows():
        found |= {f"{told}.{name}": float(row[name]) for name in METRICS}
    return found
