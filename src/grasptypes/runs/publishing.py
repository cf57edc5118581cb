"""Publish trained models to MLflow, from files: the store can be rebuilt at any time."""

from __future__ import annotations

import hashlib
import json
import logging
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from grasptypes.errors import InputError
from grasptypes.files import file_sha256
from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.scoring import CURVE_SCHEMA, METRIC_SCHEMA
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.renders.archives import read_pictures
from grasptypes.runs.tracking import RunRecord, Store, TrainedModel
from grasptypes.tables import read_table
from grasptypes.versions.git import git

logger = logging.getLogger("grasptypes")

NOTE = """\
Model `{model}`, trained on {labels} labels of the hand {hand}. Metrics are means over {runs} runs,
one for each fold and seed: the child runs. `_sd` is their standard deviation; losses are curves
over epochs. The artifacts hold the predictor and, under *figures*, the images that this model gets
wrong, and tables and curves of all models.
To see models side by side, select their runs and press *Compare*.
"""


def publish(
    models: Sequence[TrainedModel],
    settings: Mapping[str, Any],
    data: Mapping[str, Sequence[Path]],
    store: Store,
    figures: Sequence[Path] = (),
) -> dict[str, str]:
    """Upsert a parent run for each model, with its folds as children and its predictor.

    Without the backbone's weights, the runs are published without predictors. The store is locked
    for one model at a time, so that other processes need not wait for all of them.

    Args:
        settings: the `predictors` section of params.yaml that the models were trained with.
        data: what they were made from, by name: `backbone`, `renders` and others.
        figures: shown with every model.

    Returns:
        Name of each parent run to its key.

    Raises:
        InputError: the store cannot be written.
    """
    tags, keys, weights = version_tags(data), {}, None
    try:
        weights = BackboneRecord.read(data["backbone"][0]).find_weights()
    except InputError as error:
        logger.warning("runs are published without their predictors: %s", error)
    for model in models:
        record = run_record(model, settings, tags)
        with store.opened():
            store.offer_view(METRICS)
            run = store.upsert(record)
            store.log_figures(run, [*model.figures, *figures])
            if weights is not None:
                store.log_model(run, model, weights.path, read_pictures(data["renders"][0])[0])
        logger.info("%s: %d runs", record.name, 1 + len(record.children))
        keys[record.name] = record.key
    return keys


def run_record(
    model: TrainedModel, settings: Mapping[str, Any], tags: Mapping[str, str]
) -> RunRecord:
    """The parent run of a model and label source, with its folds and seeds as children.

    The keys depend only on the tables and the settings: the same results are the same runs in any
    store and checkout, published in any order.

    Args:
        settings: what it was trained with, nested like the section ``predictors`` of params.yaml.
        tags: information that is not part of the result, such as the commit; set only on new runs.
    """
    metrics = read_table(model.metrics, METRIC_SCHEMA)
    curves = read_table(model.curves, CURVE_SCHEMA)
    first = metrics.iloc[0]
    fixed = ("labels", "model", "backbone", "weights", "finetune")
    flat = pd.json_normalize(dict(settings)).to_dict("records")[0]
    stated = {"hand": model.hand, **first[list(fixed)], **flat}
    params = {name: str(value) for name, value in stated.items()}
    tags = {"hand": model.hand, **tags}
    shown = json.dumps(params, sort_keys=True).encode()
    key = _digest(model.metrics.read_bytes(), model.curves.read_bytes(), shown)
    children = []
    for row in metrics.to_dict("records"):
        fold, seed = str(row["group"]), str(row["seed"])
        own = curves[(curves["group"].astype(str) == fold) & (curves["seed"] == row["seed"])]
        child = RunRecord(
            key=_digest(key.encode(), fold.encode(), seed.encode()),
            name=f"fold {fold}, seed {seed}",
            times_ms=model.times_ms,
            params={**params, "fold": fold, "seed_number": seed},
            metrics={name: float(row[name]) for name in METRICS},
            curves=_losses(own),
            tags=tags,
        )
        children.append(child)
    # Named like those of the folds, so that the UI shows both in one column.
    summary = {name: float(metrics[name].mean()) for name in METRICS}
    summary |= {f"{name}_sd": float(metrics[name].std()) for name in METRICS}
    losses = _losses(curves.groupby("epoch").mean(numeric_only=True))
    name = f"{first['labels']} {first['model']}"
    note = NOTE.format(
        labels=first["labels"], model=first["model"], hand=model.hand, runs=len(children)
    )
    return RunRecord(key, name, model.times_ms, params, summary, losses, tags, children, note)


def _losses(table: pd.DataFrame) -> dict[str, list[float]]:
    return {name: table[name].tolist() for name in ("train_loss", "test_loss")}


def _digest(*parts: bytes) -> str:
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()[
        :32
    ]


def version_tags(data: Mapping[str, Sequence[Path]]) -> dict[str, str]:
    """Checksums of the data (of the ``sha256sum`` listing), the commit, and whether it is dirty.

    Without git, or where it refuses, the reason is printed and the tags name no commit.
    """
    tags = {}
    for name, paths in data.items():
        listing = "".join(f"{file_sha256(path)}  {path.name}\n" for path in sorted(paths))
        tags[f"sha256.{name}"] = hashlib.sha256(listing.encode()).hexdigest()
    try:
        commit = git("describe", "--always", "--exclude=*", "--abbrev=40", "--dirty").strip()
    except InputError as error:
        sys.stderr.write(f"the runs name no commit: {error}\n")
    else:
        tags["mlflow.source.git.commit"] = commit.removesuffix("-dirty")
        tags["git.dirty"] = str(commit.endswith("-dirty"))
    return tags
