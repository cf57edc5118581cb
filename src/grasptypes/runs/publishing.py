"""Show trained models in MLflow. Files are the truth: the store can be rebuilt at any time."""

from __future__ import annotations

import hashlib
import logging
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from grasptypes.downloads import file_sha256
from grasptypes.errors import InputError
from grasptypes.predictors.features import read_pictures
from grasptypes.predictors.learning_inputs import read_backbone_record, recorded_weights
from grasptypes.predictors.metrics import METRICS
from grasptypes.runs.run_records import TrainedModel, run_record
from grasptypes.runs.tracking import Store

logger = logging.getLogger("grasptypes")


def publish(
    models: Sequence[TrainedModel],
    settings: Mapping[str, Any],
    data: Mapping[str, Sequence[Path]],
    store: Store,
) -> dict[str, str]:
    """Upsert a parent run for each model, its folds below it, and its predictor.

    Without the backbone's weights the runs are published and the predictors are not. The store is
    locked for one model at a time, so that nobody waits for all of them.

    Args:
        settings: what the models were trained with, the `predictors` section of params.yaml.
        data: what they were made from, by name: `backbone`, `renders` and whatever else.

    Returns:
        Name of each parent run to its key.

    Raises:
        InputError: the store cannot be written.
    """
    tags, keys, weights = version_tags(data), {}, None
    try:
        weights = recorded_weights(read_backbone_record(data["backbone"][0]))
    except InputError as error:
        logger.warning("runs are published without their predictors: %s", error)
    for model in models:
        record = run_record(model, settings, tags)
        with store.opened() as opened:
            opened.offer_view(METRICS)
            run = opened.upsert(record)
            if weights is not None:
                opened.log_model(run, model, weights.path, read_pictures(data["renders"][0])[0])
        logger.info("%s: %d runs", record.name, 1 + len(record.children))
        keys[record.name] = record.key
    return keys


def version_tags(data: Mapping[str, Sequence[Path]]) -> dict[str, str]:
    """Of the data what ``sha256sum`` gives for its listing, the commit, and whether it is dirty."""
    tags = {}
    for name, paths in data.items():
        listing = "".join(f"{file_sha256(path)}  {path.name}\n" for path in sorted(paths))
        tags[f"sha256.{name}"] = hashlib.sha256(listing.encode()).hexdigest()
    commit = _git("rev-parse", "HEAD")
    if commit:
        tags["mlflow.source.git.commit"] = commit
        tags["git.dirty"] = str(bool(_git("status", "--porcelain", "--untracked-files=no")))
    return tags


def _git(*arguments: str) -> str:
    """What git prints; empty outside a checkout, or without git."""
    if shutil.which("git") is None:
        return ""
    command = ["git", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
