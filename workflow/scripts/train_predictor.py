"""Train and test one model on one label source: all folds and seeds, then once on everything."""

from collections.abc import Mapping
from typing import Any

import torch

from grasptypes.jobs import job
from grasptypes.predictors.predictor_files import write_predictor
from grasptypes.predictors.problem import read_problem
from grasptypes.predictors.protocol import train_final, try_splits
from grasptypes.predictors.scoring import (
    CURVE_SCHEMA,
    METRIC_SCHEMA,
    PREDICTION_SCHEMA,
    with_source,
)
from grasptypes.predictors.training import members_by_group
from grasptypes.tables import write_table


def train_predictor(
    inputs: Mapping[str, Any],
    outputs: Mapping[str, str],
    name: tuple[str, str],
    tasks: Mapping[str, Mapping[str, int]],
    settings: Mapping[str, Any],
    precision: str,
    seed: int,
) -> None:
    """Train the model `name` (labels, model) and write its tables, tensors and card.

    Args:
        inputs: those of `read_problem`.
        tasks: the section of params.yaml, those that the labels know.
        settings: the `predictors` section.
        precision: number format that frozen features were computed in.
    """
    problem = read_problem(inputs, name, tasks, settings)
    key = ("predictor", name[1], seed)
    members = members_by_group(problem.examples.index["fold"], settings["seeds"])
    outcome = try_splits(problem.examples, members, problem.recipe, key, problem.backbone)
    metrics = with_source(outcome.metrics, name, problem.record, settings["finetune"])
    write_table(metrics, outputs["metrics"], METRIC_SCHEMA)
    write_table(outcome.curves, outputs["curves"], CURVE_SCHEMA)
    write_table(outcome.predictions, outputs["predictions"], PREDICTION_SCHEMA)
    heads, tuned = train_final(problem.examples, problem.recipe, key, problem.backbone)
    card = problem.card(heads.architecture, precision)
    write_predictor(heads, tuned, card, outputs["tensors"], outputs["card"])


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        train_predictor(
            dict(snakemake.input.items()),
            dict(snakemake.output.items()),
            (snakemake.wildcards.labels, snakemake.wildcards.model),
            snakemake.params.tasks,
            snakemake.params.settings,
            snakemake.params.precision,
            snakemake.params.seed,
        )
