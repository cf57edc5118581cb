"""Runs in MLflow, made from finished files.

The store is a view: every run is identified by a key made from its content, so publishing twice
adds nothing, and a deleted store is rebuilt with the same runs.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import sqlite3
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import mlflow
import numpy as np
import yaml
from filelock import FileLock
from mlflow.entities import LifecycleStage, Metric, Param
from mlflow.exceptions import MlflowException
from mlflow.models import ModelSignature
from mlflow.types import ColSpec, Schema, TensorSpec
from sqlalchemy.exc import SQLAlchemyError

import grasptypes.errors
from grasptypes.errors import InputError
from grasptypes.files import file_sha256
from grasptypes.predictors.general_backbone import weights_of
from grasptypes.predictors.general_predictor import CARD, TRAINED, GeneralCard
from grasptypes.predictors.predictor_files import ModelCard
from grasptypes.settings.commands import TrackingSettings
from grasptypes.settings.params import Params

KEY_TAG = "grasptypes.key"
MODEL_TAG = "grasptypes.model"
NOTE_TAG = "mlflow.note.content"  # MLflow's own tag for the description of a run
FIGURES = "figures"
# MLflow's own tag for a shared view of the runs.
VIEW = "results"
VIEW_TAG = f"mlflow.sharedViewState.{VIEW}"
# Copied into every model, with the versions of its imports.
PACKAGE = Path(grasptypes.errors.__file__).parent
SERVING_PACKAGES = (
    *("efficientnet-lite-pytorch", "mlflow", "numpy", "pandas", "pandera", "pillow", "pyarrow"),
    *("pydantic", "safetensors", "scipy", "torch", "torchvision"),
)
MIN_PX = 32  # sides of the example
# Images of any size, and a task for each.
IMAGES = TensorSpec(np.dtype(np.uint8), (-1, -1, -1, 3), "image")
PREDICTOR_INPUTS = Schema([IMAGES, TensorSpec(np.dtype(str), (-1,), "task")])
# What only the predictor for unseen objects takes: 0 or empty where unknown.
GENERAL_INPUTS = Schema(
    [
        *PREDICTOR_INPUTS.inputs,
        TensorSpec(np.dtype(np.float64), (-1, 3), "size_m"),
        TensorSpec(np.dtype(np.float64), (-1,), "mass_kg"),
        TensorSpec(np.dtype(np.int64), (-1, 4), "box"),
        *(TensorSpec(np.dtype(str), (-1,), name) for name in ("mask", "depth", "intrinsics")),
    ]
)
GENERAL_PACKAGES = (
    *SERVING_PACKAGES,
    *("libigl", "manifold3d", "matplotlib", "numba", "pyyaml", "trimesh"),
)
_BATCH = 1000  # MLflow's maximum number of metrics per call
_PARAM_LENGTH = 6000  # MLflow's maximum length of a parameter


@dataclass(frozen=True)
class TrainedModel:
    """The files of one training job, its times (milliseconds since 1970), and the labels' hand.

    The figures are those that show this model alone.
    """

    metrics: Path
    curves: Path
    tensors: Path
    card: Path
    times_ms: tuple[int, int]
    hand: str
    figures: Sequence[Path] = ()


def run_key(*parts: str) -> str:
    """The key of a run, 32 hex digits: what it was made from, or its parent's key and its place."""
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:32]


@dataclass(frozen=True)
class RunRecord:
    """Content of a run. The key is made from it; an existing run with that key is updated."""

    key: str
    name: str
    times_ms: tuple[int, int]
    params: Mapping[str, str]
    metrics: Mapping[str, float]
    curves: Mapping[str, Sequence[float]]
    """One value per epoch, starting at epoch 1."""
    tags: Mapping[str, str]
    children: Sequence[RunRecord] = ()
    note: str = ""
    """The description of the run, in Markdown."""


class Store:
    """An MLflow store in one SQLite file, written by one process at a time.

    The models are stored in the same folder.
    """

    def __init__(self, settings: TrackingSettings) -> None:
        self.database = Path(settings.database).resolve()
        self.experiment = settings.experiment
        self.patience_s = settings.patience_s
        self.uri = f"sqlite:///{self.database}"

    @contextlib.contextmanager
    def opened(self) -> Iterator[None]:
        """Context for writing, while other processes wait; the lock ends with the process.

        Without it, MLflow fails when two processes create the tables of a new file, and retries for
        more than an hour to open a file that is locked or damaged.

        Raises:
            InputError: the store is locked, read-only, damaged or unreachable.
        """
        os.environ.setdefault("MLFLOW_DISABLE_TELEMETRY", "true")
        try:
            self.database.parent.mkdir(parents=True, exist_ok=True)
            with FileLock(self.database.with_suffix(".lock"), timeout=self.patience_s):
                self._check_writable()
                mlflow.set_tracking_uri(self.uri)
                self._client = mlflow.MlflowClient(self.uri)
                self._experiment = self._found_or_made()
                yield
        except (OSError, sqlite3.Error, MlflowException, SQLAlchemyError) as error:
            reason = str(error).split("\n")[0]
            later = "results are not affected; publish them later with: make publish"
            raise InputError(self.database, "", f"cannot be written: {reason}; {later}") from error

    def page(self) -> str:
        """Path in MLflow's UI of the runs with the measures as columns."""
        with self.opened():
            query = f"workflowType=machine_learning&viewStateShareKey={VIEW}"
            return f"#/experiments/{self._experiment}/runs?{query}"

    def upsert(self, record: RunRecord, parent: str | None = None) -> str:
        """Write a run and its children; returns its id.

        An existing run keeps its tags, because later commits and data are not what it was made
        from.
        """
        query = f"tags.`{KEY_TAG}` = '{record.key}'"
        found = self._client.search_runs([self._experiment], query, max_results=1)
        if found:
            run = found[0]
        else:
            tags = {**record.tags, KEY_TAG: record.key, "mlflow.runName": record.name}
            tags |= {"mlflow.parentRunId": parent} if parent else {}
            start_ms = record.times_ms[0]
            run = self._client.create_run(self._experiment, start_time=start_ms, tags=tags)
        identity = run.info.run_id
        if record.note and run.data.tags.get(NOTE_TAG) != record.note:
            self._client.set_tag(identity, NOTE_TAG, record.note)
        if run.info.status != "FINISHED":
            # With the run's own times, repeating an interrupted call adds no duplicate values.
            self._write(identity, record, run.info.start_time)
            self._client.set_terminated(identity, "FINISHED", end_time=record.times_ms[1])
        for child in record.children:
            self.upsert(child, identity)
        return str(identity)

    def offer_view(self, metrics: Sequence[str]) -> None:
        """Store a view of the runs with the hand and these metrics as columns."""
        columns = ["params.`hand`", *(f"metrics.`{name}`" for name in metrics)]
        state = json.dumps({"selectedColumns": columns})
        self._client.set_experiment_tag(self._experiment, VIEW_TAG, state)

    def log_figures(self, run: str, figures: Sequence[Path]) -> None:
        """Show figures among the artifacts of a run, those that are new or have another size."""
        there = {entry.path: entry.file_size for entry in self._client.list_artifacts(run, FIGURES)}
        for figure in figures:
            if there.get(f"{FIGURES}/{figure.name}") != figure.stat().st_size:
                self._client.log_artifact(run, str(figure), FIGURES)

    def log_model(self, run: str, model: TrainedModel, weights: Path, picture: np.ndarray) -> None:
        """Log a servable predictor with a run, unless it is already there.

        The run keeps the end time of its training.

        Args:
            weights: weights of the backbone.
            picture: an example image, (H, W, 3) uint8.
        """
        known, key = self._client.get_run(run), file_sha256(model.tensors)
        if known.data.tags.get(MODEL_TAG) == key:
            return
        # Remains of interrupted calls, or older models.
        mine = f"source_run_id = '{run}'"
        for old in self._client.search_logged_models([self._experiment], filter_string=mine):
            self._client.delete_logged_model(old.model_id)
        card = ModelCard.read(model.card)
        names, shape = ("probability", "share"), (-1, len(card.types))
        outputs: list[ColSpec | TensorSpec] = [
            TensorSpec(np.dtype(np.float32), shape, name) for name in names
        ]
        files = {"tensors": model.tensors, "card": model.card, "weights": weights}
        with mlflow.start_run(run_id=run):
            mlflow.pyfunc.log_model(
                name=f"{card.labels}_{card.model}",
                python_model=str(PACKAGE / "runs" / "serving.py"),
                artifacts={name: str(path) for name, path in files.items()},
                code_paths=[str(PACKAGE)],
                signature=ModelSignature(PREDICTOR_INPUTS, Schema(outputs)),
                input_example={"image": picture[None], "task": np.array([card.tasks[0]])},
                pip_requirements=[f"{name}=={version(name)}" for name in SERVING_PACKAGES],
            )
        self._client.set_terminated(run, known.info.status, end_time=known.info.end_time)
        self._client.set_tag(run, MODEL_TAG, key)

    def _check_writable(self) -> None:
        """Try to write, and roll back."""
        with contextlib.closing(sqlite3.connect(self.database, timeout=self.patience_s)) as probe:
            probe.isolation_level = None
            # Create a table, since SQLite touches neither file nor journal before something
            # changes.
            probe.execute("BEGIN IMMEDIATE")
            probe.execute("CREATE TABLE grasptypes_probe (a)")
            probe.execute("ROLLBACK")

    def _found_or_made(self) -> str:
        found = self._client.get_experiment_by_name(self.experiment)
        if found is None:
            place = (self.database.parent / "mlruns").as_uri()
            return str(self._client.create_experiment(self.experiment, artifact_location=place))
        if found.lifecycle_stage == LifecycleStage.DELETED:  # in the UI
            self._client.restore_experiment(found.experiment_id)
        return str(found.experiment_id)

    def _write(self, run: str, record: RunRecord, stamp_ms: int) -> None:
        params = [Param(name, value[:_PARAM_LENGTH]) for name, value in record.params.items()]
        metrics = [Metric(name, value, stamp_ms, 0) for name, value in record.metrics.items()]
        metrics += [
            Metric(name, float(value), stamp_ms, epoch)
            for name, curve in record.curves.items()
            for epoch, value in enumerate(curve, 1)
            if np.isfinite(value)
        ]
        self._client.log_batch(run, params=params)
        for start in range(0, len(metrics), _BATCH):
            self._client.log_batch(run, metrics=metrics[start : start + _BATCH])


def save_general(folder: str | Path, params: Params) -> None:
    """Write the predictor for unseen objects to a new folder that `mlflow models serve` takes.

    Raises:
        MlflowException: the folder exists and is not empty.
    """
    card = GeneralCard.read(TRAINED / CARD)
    types, shown = len(card.types), params.predict.known_kinds.shown
    outputs: list[ColSpec | TensorSpec] = [
        TensorSpec(np.dtype(np.float32), (-1, types), "probability"),
        TensorSpec(np.dtype(np.float32), (-1, types), "share"),
        TensorSpec(np.dtype(np.float32), (-1,), "strangeness"),
        TensorSpec(np.dtype(str), (-1, shown), "neighbours"),
    ]
    example = {
        "image": np.full((1, MIN_PX, MIN_PX, 3), 200, dtype=np.uint8),
        "task": np.array([card.learned[0]]),
        "size_m": np.array([[0.12, 0.0, 0.0]]),
        "mass_kg": np.zeros(1),
        "box": np.zeros((1, 4), dtype=np.int64),
        **{name: np.array([""]) for name in ("mask", "depth", "intrinsics")},
    }
    with tempfile.TemporaryDirectory() as place:
        settings = Path(place) / "params.yaml"
        settings.write_text(yaml.safe_dump(params.model_dump(mode="json", by_alias=True)))
        weights = weights_of(card.backbone, 0).path
        files = {"trained": TRAINED, "params": settings, "weights": weights}
        mlflow.pyfunc.save_model(
            str(folder),
            python_model=str(PACKAGE / "runs" / "serving.py"),
            artifacts={name: str(path) for name, path in files.items()},
            code_paths=[str(PACKAGE)],
            signature=ModelSignature(GENERAL_INPUTS, Schema(outputs)),
            input_example=example,
            pip_requirements=[f"{name}=={version(name)}" for name in GENERAL_PACKAGES],
        )
