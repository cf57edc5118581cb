"""Runs in MLflow, made from finished files.

The store is a view: every run is found again by a key made from what it shows, so publishing
twice adds nothing, and a deleted store is rebuilt with the same runs.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import logging
import os
import sqlite3
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import mlflow
import numpy as np
from mlflow.entities import LifecycleStage, Metric, Param, Run
from mlflow.exceptions import MlflowException
from mlflow.models import ModelSignature
from mlflow.types import Schema, TensorSpec
from sqlalchemy.exc import SQLAlchemyError

from grasptypes.errors import InputError
from grasptypes.runs.run_records import RunRecord

LOGGER = logging.getLogger("grasptypes")
KEY_TAG = "grasptypes.key"
MODEL_TAG = "grasptypes.model"
# MLflow's own tag for a shared view of the runs.
VIEW = "results"
VIEW_TAG = f"mlflow.sharedViewState.{VIEW}"
_BATCH = 1000  # the most metrics MLflow takes at once
_PARAM_LENGTH = 6000  # the longest parameter MLflow takes


@dataclass(frozen=True)
class LoggedModel:
    """Files of a predictor that MLflow can serve by itself.

    Attributes:
        name: of the model in MLflow.
        artifacts: what :mod:`grasptypes.runs.serving` reads, by name.
        package: folder of this package, copied into the model.
        requirements: packages of the serving environment.
        example_pictures: (1, H, W, 3) uint8.
        example_task: the task asked for.
        outputs: number of grasp types.
    """

    name: str
    artifacts: Mapping[str, Path]
    package: Path
    requirements: Sequence[str]
    example_pictures: np.ndarray
    example_task: str
    outputs: int

    def signature(self) -> ModelSignature:
        """Pictures of any size and a task each, to logit-derived probabilities."""
        inputs = [
            TensorSpec(np.dtype(np.uint8), (-1, -1, -1, 3), "image"),
            TensorSpec(np.dtype(str), (-1,), "task"),
        ]
        outputs = [
            TensorSpec(np.dtype(np.float32), (-1, self.outputs), name)
            for name in ("probability", "sigmoid")
        ]
        return ModelSignature(Schema(inputs), Schema(outputs))

    def example(self) -> dict[str, np.ndarray]:
        """One call's input."""
        return {"image": self.example_pictures, "task": np.array([self.example_task])}


class Store:
    """An MLflow store in one SQLite file, written by one process at a time.

    Args:
        database: the file; its folder also takes the models.
        experiment: name under which the runs stand.
        patience_s: how long to wait for a store that somebody else is writing.
    """

    def __init__(self, database: str | Path, experiment: str, patience_s: float) -> None:
        self.database = Path(database).resolve()
        self.experiment = experiment
        self.patience_s = patience_s
        self.uri = f"sqlite:///{self.database}"

    @contextlib.contextmanager
    def opened(self) -> Iterator[OpenStore]:
        """The store for writing; others wait. The lock ends with the process, however it ends.

        MLflow itself fails when two processes create the tables of a new file together, and tries
        for more than an hour to open a file that is locked or damaged.

        Raises:
            InputError: the store is locked, read-only, damaged or out of reach.
        """
        os.environ.setdefault("MLFLOW_DISABLE_TELEMETRY", "true")
        try:
            self.database.parent.mkdir(parents=True, exist_ok=True)
            with self.database.with_suffix(".lock").open("w") as lock:
                self._wait_for(lock)
                self._check_writable()
                mlflow.set_tracking_uri(self.uri)
                client = mlflow.MlflowClient(self.uri)
                yield OpenStore(client, self._experiment_of(client))
        except (OSError, sqlite3.Error, MlflowException, SQLAlchemyError) as error:
            reason = str(error).split("\n")[0]
            later = "results do not depend on it, show them later with: make publish"
            raise InputError(self.database, "", f"cannot be written: {reason}; {later}") from error

    def page(self) -> str:
        """Where MLflow's UI shows the runs with the measures as columns, below its own address.

        Raises:
            InputError: as `opened`.
        """
        with self.opened() as opened:
            query = f"workflowType=machine_learning&viewStateShareKey={VIEW}"
            return f"#/experiments/{opened.experiment}/runs?{query}"

    def _wait_for(self, lock: IO[str]) -> None:
        """Take the lock, or raise TimeoutError once patience is over."""
        deadline = time.monotonic() + self.patience_s
        while True:
            try:
                return fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError as error:
                if time.monotonic() > deadline:
                    message = f"another process has been publishing for {self.patience_s:g} s"
                    raise TimeoutError(message) from error
                time.sleep(0.1)

    def _check_writable(self) -> None:
        """Begin to write, and leave it at that."""
        with contextlib.closing(sqlite3.connect(self.database, timeout=self.patience_s)) as probe:
            probe.isolation_level = None
            # A table, since SQLite touches neither file nor journal before something changes.
            probe.execute("BEGIN IMMEDIATE")
            probe.execute("CREATE TABLE grasptypes_probe (a)")
            probe.execute("ROLLBACK")

    def _experiment_of(self, client: mlflow.MlflowClient) -> str:
        found = client.get_experiment_by_name(self.experiment)
        if found:
            if found.lifecycle_stage == LifecycleStage.DELETED:  # in the UI
                client.restore_experiment(found.experiment_id)
            return str(found.experiment_id)
        folder = self.database.parent / "mlruns"
        return str(client.create_experiment(self.experiment, artifact_location=folder.as_uri()))


class OpenStore:
    """The operations on an opened store."""

    def __init__(self, client: mlflow.MlflowClient, experiment: str) -> None:
        self._client = client
        self.experiment = experiment

    def find(self, key: str) -> Run | None:
        """The run with this key."""
        query = f"tags.`{KEY_TAG}` = '{key}'"
        runs = self._client.search_runs([self.experiment], query, max_results=1)
        return runs[0] if runs else None

    def upsert(self, record: RunRecord, parent: str | None = None) -> tuple[str, int]:
        """Write a run and its children; returns its id and the number of runs that are new.

        A run that is there keeps its tags: later commits and data are not those it was made from.
        """
        run = self.find(record.key)
        added = int(run is None)
        if run is None:
            tags = {**record.tags, KEY_TAG: record.key, "mlflow.runName": record.name}
            tags |= {"mlflow.parentRunId": parent} if parent else {}
            run = self._client.create_run(self.experiment, start_time=record.start_ms, tags=tags)
        identity = run.info.run_id
        if run.info.status != "FINISHED":
            # The run's own times: when an interrupted call is repeated, no value is there twice.
            self._write(identity, record, run.info.start_time)
            self._client.set_terminated(identity, "FINISHED", end_time=record.end_ms)
        for child in record.children:
            added += self.upsert(child, identity)[1]
        return identity, added

    def offer_view(self, metrics: Sequence[str]) -> None:
        """Keep a view of the runs that has these metrics as columns."""
        state = json.dumps({"selectedColumns": [f"metrics.`{name}`" for name in metrics]})
        self._client.set_experiment_tag(self.experiment, VIEW_TAG, state)

    def log_model(self, run: str, key: str, model: LoggedModel) -> bool:
        """Log a servable predictor with a run, unless the same one is there; returns if it was.

        The run keeps the time at which its training ended.
        """
        known = self._client.get_run(run)
        if known.data.tags.get(MODEL_TAG) == key:
            return False
        self._forget_models(run)
        with mlflow.start_run(run_id=run):
            mlflow.pyfunc.log_model(
                name=model.name,
                python_model=str(model.package / "runs" / "serving.py"),
                artifacts={name: str(path) for name, path in model.artifacts.items()},
                code_paths=[str(model.package)],
                signature=model.signature(),
                input_example=model.example(),
                pip_requirements=list(model.requirements),
            )
        self._client.set_terminated(run, known.info.status, end_time=known.info.end_time)
        self._client.set_tag(run, MODEL_TAG, key)
        return True

    def _forget_models(self, run: str) -> None:
        """Delete the models of a run: halves of calls that were cut off, or older ones."""
        models = self._client.search_logged_models(
            [self.experiment], filter_string=f"source_run_id = '{run}'"
        )
        for model in models:
            self._client.delete_logged_model(model.model_id)

    def _write(self, run: str, record: RunRecord, stamp_ms: int) -> None:
        params = [Param(name, str(value)[:_PARAM_LENGTH]) for name, value in record.params.items()]
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


def publish(
    store: Store,
    records: Sequence[RunRecord],
    models: Mapping[str, tuple[str, LoggedModel]],
    columns: Sequence[str] = (),
) -> int:
    """Write runs, and the models that belong to them.

    The store is locked for one record at a time, so that nobody waits for all of them.

    Args:
        models: key of a record to its model's content key and the model.
        columns: metrics that the view of the runs shows.

    Returns:
        number of runs that were not there before.

    Raises:
        InputError: the store cannot be written.
    """
    added = 0
    for record in records:
        with store.opened() as opened:
            opened.offer_view(columns)
            run, new = opened.upsert(record)
            added += new
            if record.key in models and opened.log_model(run, *models[record.key]):
                LOGGER.info("logged the model of %s", record.name)
            LOGGER.info("%s: %d new of %d runs", record.name, new, 1 + len(record.children))
    return added
