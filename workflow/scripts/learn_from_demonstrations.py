"""Test the model that is shown the task on the folds of Table I; one job per label source."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import torch

from grasptypes.jobs import job
from grasptypes.predictors.demonstrations import (
    TASKS,
    TRIAL_SCHEMA,
    read_features,
    try_demonstrations,
)
from grasptypes.predictors.predictor_files import FROZEN
from grasptypes.predictors.problem import read_problem
from grasptypes.predictors.scoring import METRIC_SCHEMA
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.settings.demonstrations import read_demonstrations
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.tables import write_table


def learn_from_demonstrations(
    files: Mapping[str, Any],
    target: str | Path,
    name: tuple[str, str],
    settings: tuple[PredictorSettings, float],
    seed: int,
) -> None:
    """Write the metrics, one row per split, kind of demonstration, fold and seed.

    Args:
        name: label source and model.
        files: those of :func:`read_problem`, and `demonstrations`, features of one file per object.
        settings: of training, and the share of training examples without a demonstration.
    """
    labels, model = name
    problem = read_problem(files, (labels, "no_task"), dict.fromkeys(TASKS, 0), settings[0])
    record = BackboneRecord.read(files["backbone"])
    found = try_demonstrations(
        problem.examples,
        read_features(files["demonstrations"]),
        read_demonstrations(),
        settings,
        seed,
    )
    used = {"backbone": record.backbone, "weights": record.weights, "finetune": FROZEN}
    table = found.assign(labels=labels, model=model, **used)
    write_table(table[[*METRIC_SCHEMA.columns, "split", "told"]], target, TRIAL_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        params = snakemake.params
        learn_from_demonstrations(
            dict(snakemake.input.items()),
            snakemake.output.metrics,
            (snakemake.wildcards.labels, params.model),
            (PredictorSettings.check(params.settings | {"finetune": FROZEN}), params.missing),
            params.seed,
        )
