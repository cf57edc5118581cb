"""From finished files to the runs that MLflow shows."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pandas as pd

from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.scoring import CURVE_SCHEMA, METRIC_SCHEMA
from grasptypes.tables import read_table

# What grasptypes.runs.serving imports, directly or not.
SERVING_PACKAGES = (
    "efficientnet-lite-pytorch",
    "mlflow",
    "numpy",
    "pandas",
    "pandera",
    "pillow",
    "pyarrow",
    "safetensors",
    "torch",
    "torchvision",
)


def serving_requirements() -> list[str]:
    """The packages a served predictor needs, at the versions it was made with."""
    return [f"{name}=={version(name)}" for name in SERVING_PACKAGES]


@dataclass(frozen=True)
class RunRecord:
    """What a run shows.

    Attributes:
        key: made from the run's content; a run with this key is updated, not added.
        name: shown in the UI.
        start_ms: when it began, milliseconds since 1970.
        end_ms: when it ended.
        params: name to value.
        metrics: name to one value.
        curves: name to a value an epoch, first epoch 1.
        tags: name to value.
        children: runs folded under this one; one level only.
    """

    key: str
    name: str
    start_ms: int
    end_ms: int
    params: Mapping[str, Any]
    metrics: Mapping[str, float]
    curves: Mapping[str, Sequence[float]] = field(default_factory=dict)
    tags: Mapping[str, str] = field(default_factory=dict)
    children: Sequence[RunRecord] = ()


@dataclass(frozen=True)
class Finished:
    """What one training job wrote.

    Attributes:
        metrics: its table of metrics, one row a fold and seed.
        curves: its loss curves.
        tensors: the final predictor.
        card: its card.
        settings: what it was trained with, nested as section ``predictors`` of params.yaml.
    """

    metrics: Path
    curves: Path
    tensors: Path
    card: Path
    settings: Mapping[str, Any]


def run_record(finished: Finished, tags: Mapping[str, str]) -> RunRecord:
    """The parent run of a model and label source, with its folds and seeds as children.

    The keys are made from the tables and the settings alone: the same results are the same runs,
    in whatever store, checkout or order they are published.

    Args:
        tags: what is no part of the result, such as the commit; kept as it is when a run is new.
    """
    metrics = read_table(finished.metrics, METRIC_SCHEMA)
    curves = read_table(finished.curves, CURVE_SCHEMA)
    first = metrics.iloc[0]
    fixed = {
        name: str(first[name]) for name in ("labels", "model", "backbone", "weights", "finetune")
    }
    shown = fixed | flatten(finished.settings)
    content = _digest(finished.metrics.read_bytes(), finished.curves.read_bytes(), _json(shown))
    times = _times_ms(finished)
    children = [
        _child(content, row, curves, shown, dict(tags), times) for row in metrics.to_dict("records")
    ]
    # Named as the folds' own, so that the UI shows both in one column.
    summary = {name: float(metrics[name].mean()) for name in METRICS}
    summary |= {f"{name}_sd": float(metrics[name].std()) for name in METRICS}
    mean = curves.groupby("epoch")[["train_loss", "test_loss"]].mean()
    return RunRecord(
        key=content,
        name=f"{first['labels']} {first['model']}",
        start_ms=times[0],
        end_ms=times[1],
        params=shown,
        metrics=summary,
        curves={str(name): mean[name].tolist() for name in mean},
        tags=tags,
        children=children,
    )


def flatten(nested: Mapping[str, Any], prefix: str = "") -> dict[str, str]:
    """Nested settings as ``section.key`` to text."""
    flat: dict[str, str] = {}
    for key, value in nested.items():
        name = f"{prefix}{key}"
        flat |= flatten(value, f"{name}.") if isinstance(value, Mapping) else {name: str(value)}
    return flat


def _child(
    parent: str,
    row: Mapping[str, Any],
    curves: pd.DataFrame,
    shown: Mapping[str, str],
    tags: dict[str, str],
    times: tuple[int, int],
) -> RunRecord:
    group, seed = str(row["group"]), int(row["seed"])
    own = curves[(curves["group"].astype(str) == group) & (curves["seed"] == seed)]
    return RunRecord(
        key=_digest(parent.encode(), group.encode(), str(seed).encode()),
        name=f"fold {group}, seed {seed}",
        start_ms=times[0],
        end_ms=times[1],
        params={**shown, "fold": group, "seed_number": str(seed)},
        metrics={name: float(row[name]) for name in METRICS},
        curves={name: own[name].tolist() for name in ("train_loss", "test_loss")},
        tags=tags,
    )


def _times_ms(finished: Finished) -> tuple[int, int]:
    """Times of the files; a store rebuilt from the same files shows the same times."""
    stamps = [int(path.stat().st_mtime * 1000) for path in (finished.metrics, finished.card)]
    return min(stamps), max(stamps)


def _json(content: Mapping[str, str]) -> bytes:
    return json.dumps(content, sort_keys=True).encode()


def _digest(*parts: bytes) -> str:
    digest = hashlib.sha256()
    for part in parts:
        digest.update(hashlib.sha256(part).digest())
    return digest.hexdigest()[:32]
