"""Test a model that has learnt from fewer images of each object; one job per model."""

from collections.abc import Sequence
from pathlib import Path

import torch

from grasptypes.jobs import job
from grasptypes.predictors.learning_curve import TRIAL_SCHEMA, try_views
from grasptypes.predictors.predictor_files import FROZEN
from grasptypes.predictors.problem import LearningProblem, read_problem
from grasptypes.predictors.scoring import with_source
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.tables import write_table


def learn_from_fewer_views(
    problem: LearningProblem, views: Sequence[int], seed: int, target: str | Path
) -> None:
    """Write the metrics, one row per number of images, fold and seed."""
    key = ("predictor", problem.model, seed)
    found = try_views(problem.examples, views, problem.settings, key)
    name = (problem.labels, problem.model)
    metrics = with_source(found, name, problem.record, FROZEN).assign(views=found["views"])
    write_table(metrics, target, TRIAL_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        wildcards, params = snakemake.wildcards, snakemake.params
        settings = PredictorSettings.check(params.settings | {"finetune": FROZEN})
        name = wildcards.labels, wildcards.model
        learn_from_fewer_views(
            read_problem(dict(snakemake.input.items()), name, params.tasks, settings),
            params.views,
            params.seed,
            snakemake.output.metrics,
        )
