"""Train and test one model on one label source: all folds and seeds, then all data."""

from collections.abc import Mapping

import torch

from grasptypes.jobs import job
from grasptypes.predictors.members import members_by_group
from grasptypes.predictors.predictor_files import write_predictor
from grasptypes.predictors.problem import LearningProblem, read_problem
from grasptypes.predictors.protocol import train_final, try_splits
from grasptypes.predictors.scoring import (
    CURVE_SCHEMA,
    METRIC_SCHEMA,
    PREDICTION_SCHEMA,
    with_source,
)
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.tables import write_table


def train_predictor(problem: LearningProblem, seed: int, outputs: Mapping[str, str]) -> None:
    """Train the problem's model and write its tables, tensors and card."""
    settings, name = problem.settings, (problem.labels, problem.model)
    key = ("predictor", problem.model, seed)
    members = members_by_group(problem.examples.index["fold"], settings.seeds)
    outcome = try_splits(problem.examples, members, settings, key, problem.backbone)
    metrics = with_source(outcome.metrics, name, problem.record, settings.finetune)
    write_table(metrics, outputs["metrics"], METRIC_SCHEMA)
    write_table(outcome.curves, outputs["curves"], CURVE_SCHEMA)
    write_table(outcome.predictions, outputs["predictions"], PREDICTION_SCHEMA)
    heads, tuned = train_final(problem.examples, settings, key, problem.backbone)
    card = problem.card(heads.architecture)
    write_predictor(heads, tuned, card, outputs["tensors"], outputs["card"])


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        name = snakemake.wildcards.labels, snakemake.wildcards.model
        settings = PredictorSettings.check(snakemake.params.settings)
        train_predictor(
            read_problem(dict(snakemake.input.items()), name, snakemake.params.tasks, settings),
            snakemake.params.seed,
            dict(snakemake.output.items()),
        )
