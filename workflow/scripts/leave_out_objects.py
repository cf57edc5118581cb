"""Test one model on objects it was not trained on, one object left out at a time."""

from collections.abc import Mapping
from typing import Any

import torch

from grasptypes.backbone import load_backbone
from grasptypes.examples import assemble
from grasptypes.folds import FOLD_SCHEMA
from grasptypes.jobs import job
from grasptypes.learning_inputs import read_backbone_record, read_inputs, recorded_weights
from grasptypes.predictor import VARIANTS
from grasptypes.protocol import recipe_of, try_splits
from grasptypes.results import METRIC_SCHEMA, with_source
from grasptypes.samples import read_samples
from grasptypes.tables import read_table, write_table
from grasptypes.training import members_by_group


def leave_out_objects(
    inputs: Mapping[str, Any],
    target: str,
    name: tuple[str, str],
    tasks: Mapping[str, Mapping[str, int]],
    settings: Mapping[str, Any],
    seed: int,
) -> None:
    """Write the metrics of the model `name` (labels, model), one row an object and seed."""
    record = read_backbone_record(inputs["backbone"])
    recipe = recipe_of(settings)
    sources = read_inputs(inputs["features"], tasks)
    samples, folds = read_samples(inputs["samples"]), read_table(inputs["folds"], FOLD_SCHEMA)
    examples = assemble(VARIANTS[name[1]], sources, samples, folds, list(tasks))
    members = members_by_group(examples.index["object"], settings["seeds"])
    backbone = None if recipe.frozen else load_backbone(recorded_weights(record), record.input_px)
    outcome = try_splits(examples, members, recipe, ("unseen", name[1], seed), backbone)
    metrics = with_source(outcome.metrics, name, record, settings["finetune"])
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
