"""Test one model on objects left out of training, one at a time with its variants."""

import torch

from grasptypes.jobs import job
from grasptypes.predictors.members import members_by_object
from grasptypes.predictors.problem import LearningProblem, read_problem
from grasptypes.predictors.protocol import try_splits
from grasptypes.predictors.scoring import METRIC_SCHEMA, with_source
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.tables import write_table


def leave_out_objects(problem: LearningProblem, seed: int, target: str) -> None:
    """Write the metrics of the problem's model, one row per object and seed."""
    settings, name = problem.settings, (problem.labels, problem.model)
    members = members_by_object(problem.examples.index["object"], settings.seeds)
    key = ("unseen", problem.model, seed)
    outcome = try_splits(problem.examples, members, settings, key, problem.backbone)
    metrics = with_source(outcome.metrics, name, problem.record, settings.finetune)
    write_table(metrics, target, METRIC_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        name = snakemake.wildcards.labels, snakemake.wildcards.model
        settings = PredictorSettings.check(snakemake.params.settings)
        leave_out_objects(
            read_problem(dict(snakemake.input.items()), name, snakemake.params.tasks, settings),
            snakemake.params.seed,
            snakemake.output.metrics,
        )
