"""Choices that the paper leaves open, changed one at a time: reports/ablations.csv.

Run from the repository, after `snakemake -j2 features data/published_samples.csv`:

    python benchmarks/ablations.py                     # all of benchmarks/ablations.yaml
    python benchmarks/ablations.py task_layer views    # some of it
    python benchmarks/ablations.py fine_tuned          # half an hour, so only if it is named

Other rows that the table already has are kept. Every row is a model trained and tested on the
folds of Table I. `sim_change` is its similarity less that of the workflow's own choice on the same
fold and seed, mean and standard error over folds and seeds; likewise `freq_change`. `fine_tuned` is
a single fold and seed. Folds share training images, so the errors are too small rather than too
large.
"""

from __future__ import annotations

import argparse
import logging
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pandas as pd
import pandera.pandas as pa
import torch
from fine_tuning import LastBlocks, first_blocks

from grasptypes.labels.samples import read_samples
from grasptypes.predictors.backbone import Backbone, load_backbone
from grasptypes.predictors.demonstrations import MODEL, beside, read_features, shown_beside
from grasptypes.predictors.examples import Examples, assemble
from grasptypes.predictors.features import encodings, extract, read_inputs
from grasptypes.predictors.folds import FOLD_SCHEMA
from grasptypes.predictors.members import members_by_group
from grasptypes.predictors.protocol import try_splits
from grasptypes.predictors.scoring import SHORT
from grasptypes.predictors.variants import VARIANTS, Variant
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.renders.archives import read_pictures
from grasptypes.seeds import rng
from grasptypes.settings.params import Params, checkout_params
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.tables import read_table, write_table
from grasptypes.yaml_files import read_yaml

SETTINGS = Path(__file__).with_name("ablations.yaml")
REPORT = "reports/ablations.csv"
SAMPLES = {"simulated": "data/samples.csv", "published": "data/published_samples.csv"}
# The models that a change can affect.
MODELS = {
    "task_layer": ["task_vector"],
    "colour_shift": ["task_in_image"],
    "probability_weight": ["task_vector", "e_mobilenet_v2"],
    "views": ["task_vector", "task_in_image"],
    "resolutions": ["task_vector", "task_in_image"],
    "fine_tuned": [
        "ignores_task",
        "no_task",
        "task_vector",
        "task_in_image",
        MODEL,
        "e_mobilenet_v2",
    ],
}
# Of these, what takes long.
ONLY_IF_NAMED = ("fine_tuned",)
_CHANGES = [f"{short}_change{end}" for short in ("sim", "freq") for end in ("", "_se")]
SCHEMA = pa.DataFrameSchema(
    {
        "labels": pa.Column(str),
        "model": pa.Column(str, pa.Check.isin([*VARIANTS, MODEL])),
        "changed": pa.Column(str, pa.Check.isin(list(MODELS))),
        "value": pa.Column(float),
        **{f"{short}_mean": pa.Column(float, pa.Check.in_range(0, 1)) for short in SHORT.values()},
        **{name: pa.Column(float, nullable=True) for name in _CHANGES},
        "n_runs": pa.Column(int, pa.Check.ge(1), description="folds and seeds"),
    },
    strict=True,
    unique=["labels", "model", "changed", "value"],
)


@dataclass(frozen=True)
class Trial:
    """One model and what it learns from.

    Attributes:
        variant: input and output of the model.
        settings: of its training.
        inputs: object to encoding to (V, F) features.
        views: number of images of each object that are trained on.
    """

    variant: Variant
    settings: PredictorSettings
    inputs: Mapping[str, Mapping[str, np.ndarray]]
    views: int


class Ablation:
    """Models trained with one choice changed.

    Args:
        values: of benchmarks/ablations.yaml.
        params: of the checkout in the current folder, with the results of its workflow.
    """

    def __init__(self, values: Mapping[str, Any], params: Params) -> None:
        self.values, self.params = values, params
        self.settings = params.predictors.changed(seeds=values["seeds"])
        self.samples = read_samples(SAMPLES[values["labels"]])
        self.folds = read_table("data/folds.csv", FOLD_SCHEMA)
        self.folds = self.folds[self.folds["object"].isin(self.samples["object"])]
        paths = [f"data/features/{name}.npz" for name in sorted(set(self.folds["object"]))]
        self.inputs = read_inputs(paths, params.colour_shifts)
        self.tasks = sorted(set(self.samples["task"]), key=list(params.colour_shifts).index)

    def rows(self, changed: str) -> Iterator[dict[str, Any]]:
        """Rows of `SCHEMA` for one choice."""
        if changed == "fine_tuned":
            yield from self.fine_tuned()
            return
        for model in MODELS[changed]:
            own: pd.DataFrame | None = None
            for value in self.values[changed]:
                metrics = self.train(self.trial(changed, value, VARIANTS[model]), model)
                own = metrics if own is None else own
                yield self.row(model, changed, value, metrics, own)

    def row(
        self, model: str, changed: str, value: float, metrics: pd.DataFrame, own: pd.DataFrame
    ) -> dict[str, Any]:
        """A row of `SCHEMA`.

        Args:
            metrics: of the runs with the value.
            own: of those with the workflow's choice.
        """
        return {"labels": self.values["labels"], "model": model, "changed": changed} | {
            "value": float(value),
            **{f"{short}_mean": metrics[name].mean() for name, short in SHORT.items()},
            **_change(metrics, own, "angular_similarity", "sim"),
            **_change(metrics, own, "frequency_similarity", "freq"),
            "n_runs": len(metrics),
        }

    def fine_tuned(self) -> Iterator[dict[str, Any]]:
        """Rows of each model with frozen features and with the last blocks trained, one fold."""
        blocks, backbone = int(self.values["fine_tuned"][1]), self.backbone().eval()
        rows, shape = self.first_blocks(backbone, blocks)
        for model in MODELS["fine_tuned"]:
            shown, pictures = model == MODEL, 2 if model == MODEL else 1
            variant = VARIANTS["no_task" if shown else model]
            key = ("predictor", model, self.params.seed)
            own: pd.DataFrame | None = None
            for count, inputs in zip((0, blocks), (self.inputs, rows), strict=True):
                examples = assemble(variant, inputs, self.samples, self.folds, self.tasks)
                member = members_by_group(examples.index["fold"], 1)[:1]
                if shown:
                    examples = self.beside_demonstrations(examples, count and (backbone, count))
                settings = self.settings.changed(finetune="last_blocks" if count else "none")
                tail = LastBlocks(backbone, count, shape, pictures) if count else None
                metrics = try_splits(examples, member, settings, key, tail).metrics
                own = metrics if own is None else own
                yield self.row(model, "fine_tuned", count, metrics, own)

    def first_blocks(
        self, backbone: Backbone, blocks: int
    ) -> tuple[dict[str, dict[str, np.ndarray]], tuple[int, int, int]]:
        """What all but the last blocks make of the images of each object, in every encoding."""
        shifts = encodings({task: self.params.colour_shifts[task] for task in self.tasks})
        found: dict[str, dict[str, np.ndarray]] = {}
        shape = (0, 0, 0)
        for name in self.inputs:
            pictures, found[name] = read_pictures(f"data/renders/{name}.zip"), {}
            for encoding, shift in shifts.items():
                batch = self.params.features.batch
                found[name][encoding], shape = first_blocks(
                    backbone, blocks, pictures, shift, batch
                )
        return found, shape

    def beside_demonstrations(
        self, examples: Examples, tail: tuple[Backbone, int] | Literal[0]
    ) -> Examples:
        """The examples, each beside a demonstration of its task and fold with another object."""
        paths = [f"data/demonstrations/features/{name}.npz" for name in self.inputs]
        shown = read_features(paths)
        features = shown.features
        if tail:
            pictures = [read_pictures(f"data/demonstrations/{name}.zip") for name in self.inputs]
            batch = self.params.features.batch
            features, _ = first_blocks(*tail, np.concatenate(pictures), 0, batch)
        fold = shown.index["view"] % self.params.folds.count
        key = (MODEL, "views", self.params.seed, "right")
        rows = shown_beside(examples.index, shown.index.assign(fold=fold), False, rng(*key))
        return beside(examples, features[rows])

    def trial(self, changed: str, value: float, variant: Variant) -> Trial:
        """The trial with one choice changed to a value."""
        most = int(self.folds["view"].max()) + 1
        trial = Trial(variant, self.settings, self.inputs, most)
        if changed == "task_layer":
            return replace(trial, variant=replace(variant, task_layer=int(value)))
        if changed == "probability_weight":
            return replace(trial, settings=self.settings.changed(probability_weight=value))
        if changed == "views":
            return replace(trial, views=int(value))
        if changed == "resolutions":
            return replace(trial, inputs=self.coarsest(int(value)))
        return replace(trial, inputs=self.shifted(int(value)))

    def train(self, trial: Trial, model: str) -> pd.DataFrame:
        """Metrics, one row per fold and seed in a fixed order."""
        views = {name: len(next(iter(shown.values()))) for name, shown in trial.inputs.items()}
        folds = self.folds[self.folds["view"] < self.folds["object"].map(views)]
        examples = assemble(trial.variant, trial.inputs, self.samples, folds, self.tasks)
        known = examples.index["view"].to_numpy() < trial.views
        members = [
            replace(member, train=member.train[known[member.train]])
            for member in members_by_group(examples.index["fold"], trial.settings.seeds)
        ]
        key = ("predictor", model, self.params.seed)
        return try_splits(examples, members, trial.settings, key).metrics

    def coarsest(self, resolutions: int) -> dict[str, dict[str, np.ndarray]]:
        """The features of some of the backbone's resolutions."""
        widths = list(self.backbone().kind.pooled.values())[-resolutions:]
        return {
            name: {encoding: features[:, -sum(widths) :] for encoding, features in shown.items()}
            for name, shown in self.inputs.items()
        }

    def shifted(self, shift: int) -> dict[str, dict[str, np.ndarray]]:
        """Features of the first images with this colour shift instead of the workflow's."""
        signs = {task: np.sign(self.params.colour_shifts[task]) for task in self.tasks}
        shifts = {task: int(sign * shift) for task, sign in signs.items()}
        backbone, batch = self.backbone(), self.params.features.batch
        found = {}
        for name in self.inputs:
            pictures = read_pictures(f"data/renders/{name}.zip")[: self.values["shifted_views"]]
            found[name] = extract(backbone, pictures, shifts, batch)
        return found

    @staticmethod
    def backbone() -> Backbone:
        """The workflow's backbone."""
        record = BackboneRecord.read("data/backbone.json")
        return load_backbone(record.find_weights(), record.input_px)


def _change(metrics: pd.DataFrame, own: pd.DataFrame, measure: str, short: str) -> dict[str, float]:
    """Change of a measure, paired by fold and seed; NaN for the workflow's own choice."""
    if metrics is own:
        return {f"{short}_change": np.nan, f"{short}_change_se": np.nan}
    change = metrics[measure] - own[measure]
    return {f"{short}_change": change.mean(), f"{short}_change_se": change.sem()}


def main() -> None:
    """Measure what the command line names, and write and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("changed", nargs="*", help=f"default: all of {', '.join(MODELS)}")
    asked = parser.parse_args().changed or [name for name in MODELS if name not in ONLY_IF_NAMED]
    if set(asked) - set(MODELS):
        parser.error(f"choose from {', '.join(MODELS)}")
    logging.basicConfig(format="%(message)s", level=logging.WARNING)
    torch.set_num_threads(1)
    ablation = Ablation(read_yaml(SETTINGS), checkout_params())
    known, rows = _known(asked), []
    for row in (row for changed in asked for row in ablation.rows(changed)):
        rows.append(row)
        sys.stdout.write(f"{row['model']}, {row['changed']} {row['value']:g}: ")
        sys.stdout.write(f"{row['sim_mean']:.3f}, frequencies {row['freq_mean']:.3f}\n")
        sys.stdout.flush()
        found = pd.DataFrame(rows)[list(SCHEMA.columns)].round(6)
        write_table(pd.concat([known, found], ignore_index=True), REPORT, SCHEMA)


def _known(asked: Sequence[str]) -> pd.DataFrame | None:
    """The rows of the table that are not measured now; None if there is no table."""
    if not Path(REPORT).is_file():
        return None
    table = read_table(REPORT, SCHEMA)
    return table[~table["changed"].isin(asked)]


if __name__ == "__main__":
    main()
