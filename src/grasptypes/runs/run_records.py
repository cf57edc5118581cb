"""From a trained model's files to the runs that MLflow shows."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.scoring import CURVE_SCHEMA, METRIC_SCHEMA
from grasptypes.tables import read_table


@dataclass(frozen=True)
class TrainedModel:
    """The files of one training job, and when it began and ended (milliseconds since 1970)."""

    metrics: Path
    curves: Path
    tensors: Path
    card: Path
    times_ms: tuple[int, int]


@dataclass(frozen=True)
class RunRecord:
    """What a run shows. A run with the same key, which is made from its content, is updated."""

    key: str
    name: str
    times_ms: tuple[int, int]
    params: Mapping[str, str]
    metrics: Mapping[str, float]
    curves: Mapping[str, Sequence[float]]
    """A value an epoch, the first epoch is 1."""
    tags: Mapping[str, str]
    children: Sequence[RunRecord] = ()


def run_record(
    model: TrainedModel, settings: Mapping[str, Any], tags: Mapping[str, str]
) -> RunRecord:
    """The parent run of a model and label source, with its folds and seeds as children.

    The keys are made from the tables and the settings alone: the same results are the same runs,
    in whatever store, checkout or order they are published.

    Args:
        settings: what it was trained with, nested as section ``predictors`` of params.yaml.
        tags: what is no part of the result, such as the commit; kept as it is when a run is new.
    """
    metrics = read_table(model.metrics, METRIC_SCHEMA)
    curves = read_table(model.curves, CURVE_SCHEMA)
    first = metrics.iloc[0]
    fixed = ("labels", "model", "backbone", "weights", "finetune")
    params = {name: str(first[name]) for name in fixed} | flatten(settings)
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
    # Named as the folds' own, so that the UI shows both in one column.
    summary = {name: float(metrics[name].mean()) for name in METRICS}
    summary |= {f"{name}_sd": float(metrics[name].std()) for name in METRICS}
    losses = _losses(curves.groupby("epoch").mean(numeric_only=True))
    name = f"{first['labels']} {first['model']}"
    return RunRecord(key, name, model.times_ms, params, summary, losses, tags, children)


def flatten(nested: Mapping[str, Any], prefix: str = "") -> dict[str, str]:
    """Nested settings as ``section.key`` to text."""
    flat: dict[str, str] = {}
    for key, value in nested.items():
        name = f"{prefix}{key}"
        flat |= flatten(value, f"{name}.") if isinstance(value, Mapping) else {name: str(value)}
    return flat


def _losses(table: pd.DataFrame) -> dict[str, list[float]]:
    return {name: table[name].tolist() for name in ("train_loss", "test_loss")}


def _digest(*parts: bytes) -> str:
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()[
        :32
    ]
