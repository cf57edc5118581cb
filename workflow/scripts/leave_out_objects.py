"""Test one model on objects it was not trained on, one left out at a time with its variants."""

from collections.abc import Mapping
from typing import Any

import torch

from grasptypes.jobs import job
from grasptypes.predictors.leaving_out import members_by_object
from grasptypes.predictors.problem import read_problem
from grasptypes.predictors.protocol import try_splits
from grasptypes.predictors.scoring import METRIC_SCHEMA, with_source
from grasptypes.tables import write_table


def leave_out_objects(
    inputs: Mapping[str, Any],
    target: str,
    name: tuple[str, str],
    tasks: Mapping[str, Mapping[str, int]],
    settings: Mapping[str, Any],
    seed: int,
) -> None:
    """Write the metrics of the model `name` (labels, model), one row an object and seed."""
    problem = read_problem(inputs, name, tasks, settings)
    members = members_by_object(problem.examples.index["object"], settings["seeds"])
    key = ("unseen", name[1], seed)
    outcome = try_splits(problem.examples, members, problem.recipe, key, problem.backbone)
    metrics = with_source(outcome.metrics, name, problem.record, settings["finetune"])
    write_table(metrics, target, METRIC_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        leave_out_objects(
            dict(snakemake.input.items()),
            snakemake.output.metrics,
            (snakemake.wildcards.labels, snakemake.wildcards.model),
            snakemake.params.tasks,
            snakemake.params.settings,
            snakemake.params.seed,
        )
