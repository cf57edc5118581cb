"""Show finished results in MLflow. Files are the truth: the store can be rebuilt at any time.

``python -m grasptypes.runs.publishing`` publishes what the current folder holds; doing it again
adds nothing.
"""

from __future__ import annotations

import hashlib
import logging
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import grasptypes.errors
from grasptypes.downloads import file_sha256
from grasptypes.errors import InputError
from grasptypes.predictors.features import read_pictures
from grasptypes.predictors.learning_inputs import read_backbone_record, recorded_weights
from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.predictor_files import read_card
from grasptypes.predictors.weights import Weights
from grasptypes.runs.due import note_done
from grasptypes.runs.run_records import Finished, run_record, serving_requirements
from grasptypes.runs.tracking import LoggedModel, Store, publish
from grasptypes.settings.params import read_params
from grasptypes.versions.job_records import recorded_params

logger = logging.getLogger(__name__)

# What every run tells of the data it was made from: files, and folders as a whole.
VERSIONED = (
    "data/backbone.json",
    "data/samples.csv",
    "data/published_samples.csv",
    "data/folds.csv",
    "data/renders",
    "data/features",
)


def finished_models(root: Path) -> list[Finished]:
    """Every model and label source whose files are all there, in the order of their names.

    params.yaml may have changed since: Snakemake's record tells what a model was trained with.
    """
    found = []
    for card in sorted(root.glob("models/*/*/predictor.json")):
        name = Path(*card.parts[-3:-1])
        metrics = root / "reports/metrics" / name.with_suffix(".csv")
        curves = root / "reports/loss_curves" / name.with_suffix(".csv")
        tensors = card.with_name("predictor.safetensors")
        if not (metrics.is_file() and curves.is_file() and tensors.is_file()):
            continue
        settings = _settings(card.relative_to(root), root)
        if settings is None:
            logger.warning("%s is left out: no record of what it was trained with", name)
        else:
            found.append(Finished(metrics, curves, tensors, card, settings))
    return found


def _settings(card: Path, root: Path) -> Mapping[str, Any] | None:
    """The section of the parameters among those of the training job; others have other keys."""
    recorded = recorded_params(str(card), root)
    return next((part for part in recorded if isinstance(part, dict) and "finetune" in part), None)


def version_tags(root: Path) -> dict[str, str]:
    """The commit, whether the checkout differs from it, and checksums of the data."""
    tags = {f"sha256.{name}": checksum(root / name) for name in VERSIONED if (root / name).exists()}
    commit = _git(root, "rev-parse", "HEAD")
    if commit:
        tags["mlflow.source.git.commit"] = commit
        tags["git.dirty"] = str(bool(_git(root, "status", "--porcelain", "--untracked-files=no")))
    return tags


def checksum(path: Path) -> str:
    """SHA-256 of a file, or of what ``sha256sum *`` prints in a folder."""
    if path.is_file():
        return file_sha256(path)
    lines = [f"{file_sha256(file)}  {file.name}\n" for file in sorted(path.iterdir())]
    return hashlib.sha256("".join(lines).encode()).hexdigest()


def publish_runs(
    finished: Sequence[Finished], root: Path, tags: Mapping[str, str], store: Store
) -> int:
    """Upsert a parent run for each finished model, its folds below it, and its predictor.

    Without the backbone's weights, or pictures for an example, the runs are published and the
    predictors are not.

    Returns:
        how many runs are new.
    """
    pairs = [(run_record(files, tags), files) for files in finished]
    models: dict[str, tuple[str, LoggedModel]] = {}
    try:
        weights = recorded_weights(read_backbone_record(root / "data/backbone.json"))
        example = _example(root / "data/renders")
    except InputError as error:
        logger.warning("runs are published without their predictors: %s", error)
    else:
        models = {
            record.key: (file_sha256(files.tensors), _servable(files, weights, example))
            for record, files in pairs
        }
    return publish(store, [record for record, _ in pairs], models, METRICS)


def _example(renders: Path) -> np.ndarray:
    """One picture, as predictors take it: (1, H, W, 3) uint8."""
    archives = sorted(renders.glob("*.zip"))
    if not archives:
        raise InputError(renders, "", "holds no pictures to show what a predictor takes")
    return read_pictures(archives[0])[:1]


def _servable(files: Finished, weights: Weights, example: np.ndarray) -> LoggedModel:
    """The predictor with all it needs to answer; example (1, H, W, 3) uint8."""
    card = read_card(files.card)
    return LoggedModel(
        f"{card.labels}_{card.model}",
        {"tensors": files.tensors, "card": files.card, "weights": weights.path},
        Path(grasptypes.errors.__file__).parent,
        serving_requirements(),
        example,
        card.tasks[0],
        len(card.types),
    )


def _git(root: Path, *arguments: str) -> str:
    """What git prints; empty outside a checkout, or without git."""
    if shutil.which("git") is None:
        return ""
    command = ["git", "-C", str(root), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def chosen_store(root: Path) -> Store:
    """The store that params.yaml names.

    Raises:
        InputError: the parameters cannot be read.
    """
    settings = read_params(root / "params.yaml").tracking
    return Store(root / settings.database, settings.experiment, settings.patience_s)


def publish_folder(root: Path, store: Store) -> None:
    """Publish a checkout's models and tell how many runs are new.

    Raises:
        InputError: there are none, or the store cannot be written.
    """
    finished = finished_models(root)
    if not finished:
        raise InputError("models", "", "holds no finished predictor; run snakemake first")
    new = publish_runs(finished, root, version_tags(root), store)
    note_done(root)
    logger.info("%s: %d models, %d new runs", store.uri, len(finished), new)


def main() -> None:
    """Publish the current folder's models; bad input ends with one line."""
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    try:
        publish_folder(Path.cwd(), chosen_store(Path.cwd()))
    except InputError as error:
        sys.exit(f"error: {error}")


if __name__ == "__main__":
    main()
