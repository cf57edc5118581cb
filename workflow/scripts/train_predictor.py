"""Train and test one model on one label source: all folds and seeds, then once on everything."""

from collections.abc import Mapping
from typing import Any

import torch

from grasptypes.backbone import load_backbone
from grasptypes.examples import assemble
from grasptypes.features import encodings
from grasptypes.folds import FOLD_SCHEMA
from grasptypes.jobs import job
from grasptypes.learning_inputs import (
    BackboneRecord,
    read_backbone_record,
    read_inputs,
    recorded_weights,
)
from grasptypes.predictor import VARIANTS
from grasptypes.predictor_files import Card, write_predictor
from grasptypes.protocol import Recipe, recipe_of, train_final, try_splits
from grasptypes.results import CURVE_SCHEMA, METRIC_SCHEMA, PREDICTION_SCHEMA, with_source
from grasptypes.samples import TYPES, read_samples
from grasptypes.tables import read_table, write_table
from grasptypes.training import members_by_group


def train_predictor(
    inputs: Mapping[str, Any],
    outputs: Mapping[str, str],
    name: tuple[str, str],
    tasks: Mapping[str, Mapping[str, int]],
    settings: Mapping[str, Any],
    seed: int,
) -> None:
    """Train the model `name` (labels, model) and write its tables, tensors and card."""
    record = read_backbone_record(inputs["backbone"])
    recipe, variant, key = recipe_of(settings), VARIANTS[name[1]], ("predictor", name[1], seed)
    sources = read_inputs(inputs["features"], tasks)
    samples, folds = read_samples(inputs["samples"]), read_table(inputs["folds"], FOLD_SCHEMA)
    examples = assemble(variant, sources, samples, folds, list(tasks))
    members = members_by_group(examples.index["fold"], settings["seeds"])
    backbone = None if recipe.frozen else load_backbone(recorded_weights(record), record.input_px)
    outcome = try_splits(examples, members, recipe, key, backbone)
    metrics = with_source(outcome.metrics, name, record, settings["finetune"])
    write_table(metrics, outputs["metrics"], METRIC_SCHEMA)
    write_table(outcome.curves, outputs["curves"], CURVE_SCHEMA)
    write_table(outcome.predictions, outputs["predictions"], PREDICTION_SCHEMA)
    heads, tuned = train_final(examples, recipe, key, backbone)
    card = _card(name, heads.architecture, record, tasks, recipe)
    write_predictor(heads, tuned, card, outputs["tensors"], outputs["card"])


def _card(
    name: tuple[str, str],
    architecture: Any,
    record: BackboneRecord,
    tasks: Mapping[str, Mapping[str, int]],
    recipe: Recipe,
) -> Card:
    shifts = {task: encodings(tasks)[task] for task in tasks}
    return Card(
        model=name[1],
        labels=name[0],
        types=TYPES,
        tasks=tuple(tasks),
        colour_shifts=shifts,
        architecture=architecture,
        backbone=record.backbone,
        weights=record.weights,
        input_px=record.input_px,
        finetune=recipe.tuning.finetune,
    )


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        train_predictor(
            dict(snakemake.input.items()),
            dict(snakemake.output.items()),
            (snakemake.wildcards.labels, snakemake.wildcards.model),
            snakemake.params.tasks,
            snakemake.params.settings,
            snakemake.params.seed,
        )
