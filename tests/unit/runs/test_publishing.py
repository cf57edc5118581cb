"""From a folder of results to a real store: tags, nothing twice, and failures in one line."""

import hashlib
import json
import logging
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import mlflow
import pandas as pd
import pytest

from grasptypes.errors import InputError
from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.scoring import CURVE_SCHEMA, METRIC_SCHEMA
from grasptypes.predictors.weights import WEIGHTS_VARIABLE
from grasptypes.runs import ui
from grasptypes.runs.publishing import (
    checksum,
    chosen_store,
    finished_models,
    publish_runs,
    version_tags,
)
from grasptypes.runs.tracking import KEY_TAG, Store
from grasptypes.tables import write_table
from grasptypes.versions.job_records import UNFINISHED, record_path
from grasptypes.yaml_files import read_yaml

PROJECT = Path(__file__).parents[3]
CARD = "models/simulated/no_task/predictor.json"


def git(root, *arguments):
    who = ["-c", "user.name=A", "-c", "user.email=a@example.org"]
    command = ["git", "-C", str(root), *who, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A checkout with one trained model: two folds, one seed."""
    root = tmp_path_factory.mktemp("checkout")
    params = read_yaml(PROJECT / "params.yaml")
    trained_with = ["'c0de'", "0", repr(params["predictors"]), repr(params["tasks"])]
    files = {
        "params.yaml": (PROJECT / "params.yaml").read_text(),
        str(record_path(CARD)): json.dumps({"rule": "train_predictor", "params": trained_with}),
        "data/samples.csv": "object,task\n",
        "data/folds.csv": "object,view,fold\n",
        "data/features/apple.npz": "a",
        "data/features/bowl.npz": "b",
        "data/backbone.json": json.dumps(
            {"backbone": "mobilenet_v2", "weights": "elsewhere", "sha256": "0", "input_px": 224}
        ),
        CARD: "{}",
        "models/simulated/no_task/predictor.safetensors": "",
        ".gitignore": "/mlflow.*\n/mlruns/\n",
    }
    for name, content in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(content)
    for folder in ("metrics", "loss_curves"):
        (root / "reports" / folder / "simulated").mkdir(parents=True)
    folds = [
        {"labels": "simulated", "model": "no_task", "group": group, "seed": 0, "n_train": 8,
         "n_test": 2, **dict.fromkeys(METRICS, 0.5), "backbone": "mobilenet_v2",
         "weights": "elsewhere", "finetune": "none"}
        for group in "01"
    ]  # fmt: skip
    curves = [
        {"group": group, "seed": 0, "epoch": 1, "train_loss": 1.0, "test_loss": 2.0}
        for group in "01"
    ]
    write_table(pd.DataFrame(folds), root / "reports/metrics/simulated/no_task.csv", METRIC_SCHEMA)
    write_table(
        pd.DataFrame(curves), root / "reports/loss_curves/simulated/no_task.csv", CURVE_SCHEMA
    )
    git(root, "init", "-q")
    git(root, "add", ".")
    git(root, "commit", "-qm", "results")
    return root


def publish(root):
    """What ``make publish`` does; returns how many runs are new."""
    return publish_runs(finished_models(root), root, version_tags(root), chosen_store(root))


def runs(root):
    client = mlflow.MlflowClient(f"sqlite:///{root / 'mlflow.db'}")
    experiment = client.get_experiment_by_name("grasptypes")
    found = client.search_runs([experiment.experiment_id])
    return {run.data.tags[KEY_TAG]: run for run in found}


def test_every_run_names_commit_and_data(results):
    publish(results)
    found = runs(results)
    assert len(found) == 3
    for run in found.values():
        tags = run.data.tags
        assert tags["mlflow.source.git.commit"] == git(results, "rev-parse", "HEAD")
        assert tags["git.dirty"] == "False"
        for name in ("data/samples.csv", "data/folds.csv", "data/backbone.json"):
            expected = hashlib.sha256((results / name).read_bytes()).hexdigest()
            assert tags[f"sha256.{name}"] == expected
        assert tags["sha256.data/features"] == checksum(results / "data/features")
        assert "sha256.data/renders" not in tags  # not there


def test_without_git_runs_name_no_commit(results, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    tags = version_tags(results)
    assert "sha256.data/samples.csv" in tags
    assert "mlflow.source.git.commit" not in tags


def test_parameters_without_a_store_are_refused(results, tmp_path):
    text = (results / "params.yaml").read_text()
    (tmp_path / "params.yaml").write_text(text.replace("\ntracking:", "\ntrakcing:"))
    with pytest.raises(InputError, match="trakcing"):
        chosen_store(tmp_path)


def test_folds_stand_one_level_below_their_model(results):
    publish(results)
    parents = [run.data.tags.get("mlflow.parentRunId") for run in runs(results).values()]
    (top,) = [run for run in runs(results).values() if "mlflow.parentRunId" not in run.data.tags]
    assert sorted(map(str, parents)) == sorted(["None", top.info.run_id, top.info.run_id])


def test_again_adds_nothing_and_a_store_is_rebuilt_alike(results, tmp_path):
    publish(results)
    before = runs(results)
    assert publish(results) == 0
    assert {k: r.info.run_id for k, r in runs(results).items()} == {
        k: r.info.run_id for k, r in before.items()
    }
    # In a copy, since this process keeps a deleted file open.
    copy = tmp_path / "copy"
    shutil.copytree(results, copy, ignore=shutil.ignore_patterns("mlflow.*", "mlruns"))
    assert publish(copy) == 3
    after = runs(copy)
    assert {k: (r.data.params, r.data.metrics, r.info.start_time) for k, r in after.items()} == {
        k: (r.data.params, r.data.metrics, r.info.start_time) for k, r in before.items()
    }


def test_runs_show_what_they_were_trained_with_whatever_params_yaml_says_now(results):
    publish(results)
    before = (results / "params.yaml").read_text()
    epochs = read_yaml(results / "params.yaml")["predictors"]["epochs"]
    (results / "params.yaml").write_text(before.replace(f"  epochs: {epochs}\n", "  epochs: 1\n"))
    try:
        assert read_yaml(results / "params.yaml")["predictors"]["epochs"] == 1
        assert publish(results) == 0
    finally:
        (results / "params.yaml").write_text(before)
    assert {run.data.params["epochs"] for run in runs(results).values()} == {str(epochs)}


def test_a_model_whose_settings_nobody_knows_is_left_out(results, caplog):
    begun = results / record_path(CARD, UNFINISHED)
    begun.parent.mkdir()
    begun.touch()  # killed with the files written, and the record still that of older ones
    assert finished_models(results) == []
    assert "simulated/no_task is left out" in caplog.text
    begun.unlink()
    record = results / record_path(CARD)
    content = record.read_text()
    record.unlink()
    assert finished_models(results) == []
    record.write_text(content)
    assert len(finished_models(results)) == 1


def test_the_ui_opens_the_chosen_store_at_its_runs_even_if_nothing_can_be_published(
    results, tmp_path, caplog
):
    link = ui.prepare(results, chosen_store(results), 5000)
    identity = re.fullmatch(r"http://127\.0\.0\.1:5000/#/experiments/(\d+)/runs\?.+", link)[1]
    assert {run.info.experiment_id for run in runs(results).values()} == {identity}
    other = Store(tmp_path / "other.db", "other", 60)
    assert "/#/experiments/1/runs?" in ui.prepare(tmp_path, other, 5000)
    assert "no finished predictor" in caplog.text
    damaged = Store(tmp_path / "damaged.db", "other", 60)
    damaged.database.write_text("no database")
    assert ui.prepare(results, damaged, 5000) == "http://127.0.0.1:5000/"
    assert "damaged.db: cannot be written" in caplog.text


def test_without_the_weights_the_runs_are_published_all_the_same(results, caplog):
    with caplog.at_level(logging.WARNING):
        publish(results)
    assert "published without their predictors" in caplog.text
    assert len(runs(results)) == 3


def test_without_pictures_the_runs_are_published_all_the_same(results, caplog, monkeypatch):
    monkeypatch.setattr("grasptypes.runs.publishing.recorded_weights", lambda record: record)
    with caplog.at_level(logging.WARNING):
        publish(results)
    assert "holds no pictures" in caplog.text
    assert len(runs(results)) == 3


def test_the_checksum_of_a_folder_is_that_of_its_listing(results):
    command = "cd data/features && sha256sum * | sha256sum"
    shell = subprocess.run(
        command, shell=True, cwd=results, capture_output=True, text=True, check=True
    )
    assert checksum(results / "data/features") == shell.stdout.split()[0]


def test_a_store_that_cannot_be_written_costs_one_line(results, tmp_path):
    """And says what to do later; the call itself may fail, since nothing waits for it."""
    params = read_yaml(results / "params.yaml")
    text = (results / "params.yaml").read_text()
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    database = params["tracking"]["database"]
    changed = text.replace(f"database: {database}", f"database: {blocked}/mlflow.db")
    (results / "params.yaml").write_text(changed)
    environment = {**os.environ, "PYTHONPATH": str(PROJECT / "src")}
    environment.pop(WEIGHTS_VARIABLE, None)
    command = [sys.executable, "-m", "grasptypes.runs.publishing"]
    called = subprocess.run(command, cwd=results, env=environment, capture_output=True, text=True)
    (results / "params.yaml").write_text(text)
    assert called.returncode == 1
    lines = [line for line in called.stderr.splitlines() if "predictors" not in line]
    assert len(lines) == 1
    assert lines[0].startswith(f"error: {blocked}/mlflow.db: cannot be written: ")
    assert lines[0].endswith("show them later with: make publish")
