"""Test one model on objects left out in all shapes, trained on more shapes of the others."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd
import torch

from grasptypes.files import read_npz
from grasptypes.jobs import job
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.features import read_inputs
from grasptypes.predictors.generalisation import TRIAL_SCHEMA, Inputs, VariantInputs, try_trial
from grasptypes.predictors.predictor_files import FROZEN
from grasptypes.predictors.scoring import with_source
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.settings.predictors import PredictorSettings, VariantTrial
from grasptypes.tables import write_table


def read_variants(paths: Sequence[str]) -> Inputs:
    """Variant to encoding to features, from files of `picture_variants`."""
    variants: Inputs = {}
    for path in paths:
        for name, array in read_npz(path).items():
            variant, encoding = name.split("/")
            variants.setdefault(variant, {})[encoding] = array
    return variants


def leave_out_shapes(
    inputs: Mapping[str, Any],
    target: str | Path,
    name: tuple[str, str],
    settings: Mapping[str, Any],
    seed: int,
) -> None:
    """Write the metrics of the model `name` (labels, model), one row per trial, object and seed."""
    record = BackboneRecord.read(inputs["backbone"])
    known = VariantInputs(
        read_inputs(inputs["objects"], settings["tasks"]),
        read_variants(inputs["variants"]),
        read_samples(inputs["samples"]),
        list(settings["tasks"]),
    )
    training = PredictorSettings.check(settings["predictors"] | {"finetune": FROZEN})
    draws, tables = (settings["seeds"], seed), []
    for trial in map(VariantTrial.check, settings["trials"]):
        metrics = try_trial(known, name[1], trial, training, draws)
        table = with_source(metrics, name, record, FROZEN)
        tables.append(table.assign(shapes=trial.shapes, views=trial.views))
    write_table(pd.concat(tables, ignore_index=True), target, TRIAL_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        leave_out_shapes(
            dict(snakemake.input.items()),
            snakemake.output.metrics,
            (snakemake.wildcards.labels, snakemake.wildcards.model),
            snakemake.params.settings,
            snakemake.params.seed,
        )
