"""From a trained model's files to a real store: nothing twice, rebuilt alike."""

import contextlib
import hashlib
import json
import sqlite3
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import mlflow
import pandas as pd
import pytest
from filelock import FileLock
from learning import ROOT, random_weights, small_predictor

from grasptypes.errors import InputError
from grasptypes.files import write_json
from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.scoring import CURVE_SCHEMA, METRIC_SCHEMA
from grasptypes.predictors.weights import WEIGHTS_VARIABLE
from grasptypes.runs import ui
from grasptypes.runs.publishing import publish, run_record, version_tags
from grasptypes.runs.tracking import KEY_TAG, VIEW_TAG, RunRecord, Store, TrainedModel
from grasptypes.settings.commands import TrackingSettings
from grasptypes.tables import write_table

SETTINGS = {"seeds": 1, "finetuning": {"epochs": 3}}
TIMES_MS = (1000, 61_000)
RUN = RunRecord("key", "name", TIMES_MS, {"a": "b"}, {"m": 0.5}, {"loss": [3.0, 2.0]}, {})


def store_in(folder, patience_s=60):
    return Store(
        TrackingSettings(database=f"{folder}/mlflow.db", experiment="test", patience_s=patience_s)
    )


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """A trained model of two folds and one seed; its predictor only looks trained."""
    root = tmp_path_factory.mktemp("model")
    row = {
        **{"labels": "simulated", "model": "no_task", "seed": 0, "n_train": 8, "n_test": 2},
        **{"backbone": "mobilenet_v2", "weights": "random", "finetune": "none"},
    }
    folds = [row | {"group": str(k), **dict.fromkeys(METRICS, 0.5 + 0.1 * k)} for k in range(2)]
    curves = [
        {"group": str(k), "seed": 0, "epoch": e, "train_loss": 3.0 - e, "test_loss": 4.0 - e + k}
        for k in range(2)
        for e in (1, 2)
    ]
    write_table(pd.DataFrame(folds), root / "metrics.csv", METRIC_SCHEMA)
    write_table(pd.DataFrame(curves), root / "curves.csv", CURVE_SCHEMA)
    small_predictor(root, random_weights(root / "random.pth"), "no_task")
    names = ("metrics.csv", "curves.csv", "predictor.safetensors", "predictor.json")
    return TrainedModel(*(root / name for name in names), TIMES_MS, "barrett")


@pytest.fixture(scope="module")
def data(model):
    """What it was made from, with the record of weights that nobody here has."""
    root = model.card.parent
    record = {"backbone": "mobilenet_v2", "weights": "elsewhere", "sha256": "0", "input_px": 32}
    write_json(root / "backbone.json", record)
    return {"backbone": [root / "backbone.json"], "tables": [model.metrics, model.curves]}


@pytest.fixture(scope="module")
def store(tmp_path_factory, model, data):
    """A store with the runs in it; making its tables takes seconds, so it is made once."""
    store = store_in(tmp_path_factory.mktemp("store"))
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv(WEIGHTS_VARIABLE, raising=False)
        keys = publish([model], SETTINGS, data, store)
    assert keys == {"simulated no_task": run_record(model, SETTINGS, {}).key}
    return store


def shown(store):
    """Key to what a run shows, and the store's own number of it."""
    client = mlflow.MlflowClient(store.uri)
    runs = client.search_runs([client.get_experiment_by_name(store.experiment).experiment_id])
    keys = {run.info.run_id: run.data.tags[KEY_TAG] for run in runs}
    return {
        run.data.tags[KEY_TAG]: (
            keys.get(run.data.tags.get("mlflow.parentRunId")),
            run.data.params,
            run.data.metrics,
            (run.info.start_time, run.info.end_time, run.info.status),
        )
        for run in runs
    }


def test_folds_stand_below_their_model_with_the_times_of_the_training(store, model):
    record = run_record(model, SETTINGS, {})
    runs = shown(store)
    assert {key: run[0] for key, run in runs.items()} == {
        record.key: None,
        **{child.key: record.key for child in record.children},
    }
    assert {run[3] for run in runs.values()} == {(*TIMES_MS, "FINISHED")}
    parent, child = runs[record.key], runs[record.children[1].key]
    assert parent[2]["angular_similarity"] == pytest.approx(0.55)
    assert parent[2]["angular_similarity_sd"] == pytest.approx(0.0707, abs=1e-4)
    assert (child[1]["fold"], child[2]["angular_similarity"]) == ("1", 0.6)
    assert (child[1]["finetuning.epochs"], child[2]["test_loss"]) == ("3", 3.0)


def test_a_model_is_described_and_shows_figures_once(store, model, data, tmp_path):
    client = mlflow.MlflowClient(store.uri)
    key = run_record(model, SETTINGS, {}).key
    experiment = client.get_experiment_by_name(store.experiment).experiment_id
    for content in (b"first", b"second one"):
        (tmp_path / "table1.png").write_bytes(content)
        publish([model], SETTINGS, data, store, [tmp_path / "table1.png"])
        (run,) = client.search_runs([experiment], f"tags.`{KEY_TAG}` = '{key}'")
        assert "means over 2 runs" in run.data.tags["mlflow.note.content"]
        (figure,) = client.list_artifacts(run.info.run_id, "figures")
        assert (figure.path, figure.file_size) == ("figures/table1.png", len(content))
    assert shown(store)[key][3] == (*TIMES_MS, "FINISHED")


def test_each_model_shows_its_own_figures_too(store, model, data, tmp_path):
    own, common = tmp_path / "misclassified.png", tmp_path / "table1.png"
    for figure in (own, common):
        figure.write_bytes(figure.name.encode())
    publish([replace(model, figures=(own,))], SETTINGS, data, store, [common])
    client = mlflow.MlflowClient(store.uri)
    key = run_record(model, SETTINGS, {}).key
    experiment = client.get_experiment_by_name(store.experiment).experiment_id
    (run,) = client.search_runs([experiment], f"tags.`{KEY_TAG}` = '{key}'")
    there = {Path(entry.path).name for entry in client.list_artifacts(run.info.run_id, "figures")}
    assert there == {own.name, common.name}


def test_runs_show_the_hand_as_a_tag_and_a_column(store, model):
    client = mlflow.MlflowClient(store.uri)
    experiment = client.get_experiment_by_name(store.experiment)
    runs = client.search_runs([experiment.experiment_id])
    assert {(run.data.tags["hand"], run.data.params["hand"]) for run in runs} == {
        ("barrett", "barrett")
    }
    assert "params.`hand`" in json.loads(experiment.tags[VIEW_TAG])["selectedColumns"]
    other = run_record(replace(model, hand="allegro"), SETTINGS, {})
    assert other.key != run_record(model, SETTINGS, {}).key


def test_publishing_again_adds_nothing_and_a_new_store_shows_the_same(store, model, data, tmp_path):
    before = shown(store)
    publish([model], SETTINGS, data, store)
    assert shown(store) == before
    publish([model], SETTINGS, data, store_in(tmp_path))
    assert shown(store_in(tmp_path)) == before


def test_keys_are_made_from_content_alone(model, tmp_path):
    record = run_record(model, SETTINGS, {"commit": "abc"})
    assert len({record.key, *(child.key for child in record.children)}) == 3
    assert run_record(model, SETTINGS, {"commit": "def"}).key == record.key
    assert run_record(model, SETTINGS | {"seeds": 3}, {}).key != record.key
    other = tmp_path / "metrics.csv"
    other.write_text(model.metrics.read_text().replace("0.6", "0.7"))
    assert run_record(replace(model, metrics=other), SETTINGS, {}).key != record.key


def test_runs_name_the_commit_and_the_data(data, tmp_path, monkeypatch, capsys):
    listing = "".join(
        f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n"
        for path in sorted(data["tables"])
    )
    tags = version_tags(data)
    assert tags["sha256.tables"] == hashlib.sha256(listing.encode()).hexdigest()
    assert len(tags["mlflow.source.git.commit"]) == 40
    assert capsys.readouterr().err == ""
    for name, value, reason in (
        ("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1", "git says: fatal: detected dubious ownership"),
        ("PATH", str(tmp_path), "git: is not installed"),
    ):
        monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")
        monkeypatch.setenv(name, value)
        assert not {"mlflow.source.git.commit", "git.dirty"} & set(version_tags(data))
        assert reason in capsys.readouterr().err


def test_an_interrupted_call_is_finished_without_doubling(store):
    client = mlflow.MlflowClient(store.uri)
    with store.opened():
        run = client.create_run(store._experiment, start_time=1000, tags={KEY_TAG: "key"})
        store._write(run.info.run_id, RUN, 1000)  # killed before it was marked as finished
        assert store.upsert(RUN) == run.info.run_id
    history = client.get_metric_history(run.info.run_id, "loss")
    assert [(metric.step, metric.value) for metric in history] == [(1, 3), (2, 2)]
    client.delete_run(run.info.run_id)


def test_an_experiment_that_was_deleted_in_the_ui_is_restored(store):
    client = mlflow.MlflowClient(store.uri)
    client.delete_experiment(client.get_experiment_by_name("test").experiment_id)
    with store.opened():
        assert client.get_experiment(store._experiment).lifecycle_stage == "active"


def test_the_ui_opens_on_this_machine_alone_at_the_runs(store, monkeypatch, capsys):
    called = []
    monkeypatch.setattr("os.execv", lambda _, command: called.append(" ".join(command)))
    monkeypatch.setattr(ui, "Store", lambda _: store)
    monkeypatch.chdir(ROOT)
    ui.serve("5000")
    assert f"mlflow ui --backend-store-uri {store.uri} --host 127.0.0.1 --port 5000" in called[0]
    assert capsys.readouterr().out.startswith("runs: http://127.0.0.1:5000/#/experiments/1/runs?")


def test_two_processes_on_a_new_file(tmp_path):
    code = (
        "import sys; sys.path[:0] = sys.argv[2:]\n"
        "from test_publishing import RUN, store_in\n"
        "store = store_in(sys.argv[1])\nwith store.opened(): store.upsert(RUN)\n"
    )
    here = Path(__file__)
    paths = [str(path) for path in (here.parent, here.parents[1], here.parents[3] / "src")]
    command = [sys.executable, "-c", code, str(tmp_path), *paths]
    processes = [subprocess.Popen(command, stderr=subprocess.PIPE) for _ in range(2)]
    assert [(p.communicate()[1][-300:], p.returncode)[1] for p in processes] == [0, 0]
    assert list(shown(store_in(tmp_path))) == ["key"]


@contextlib.contextmanager
def locked_by_a_writer(folder):
    with contextlib.closing(sqlite3.connect(folder / "mlflow.db")) as connection:
        connection.execute("BEGIN EXCLUSIVE")
        yield


@contextlib.contextmanager
def read_only(folder):
    """SQLite needs a journal to write; file modes would not stop an administrator."""
    with contextlib.closing(sqlite3.connect(folder / "mlflow.db")) as database:
        database.execute("CREATE TABLE a (b)")
    (folder / "mlflow.db-journal").mkdir()
    yield


@contextlib.contextmanager
def damaged(folder):
    (folder / "mlflow.db").write_bytes(b"no database" * 100)
    yield


@contextlib.contextmanager
def out_of_reach(folder):
    folder.rmdir()
    folder.write_text("where the store's folder would be")
    yield


@pytest.mark.parametrize(
    ("spoilt", "reason"),
    [
        (lambda folder: FileLock(folder / "mlflow.lock"), "mlflow.lock"),
        (locked_by_a_writer, "locked"),
        (read_only, "disk I/O error|unable to open"),
        (damaged, "not a database"),
        (out_of_reach, "exists|directory"),
    ],
)
def test_a_store_that_cannot_be_written_is_named_at_once(tmp_path, spoilt, reason):
    folder = tmp_path / "store"
    folder.mkdir()
    begun = time.monotonic()
    with (
        spoilt(folder),
        pytest.raises(InputError, match=rf"mlflow\.db: cannot be written: .*({reason})") as error,
        store_in(folder, 0.2).opened(),
    ):
        pass
    assert time.monotonic() - begun < 5
    assert str(error.value).endswith("publish them later with: make publish")
    assert "\n" not in str(error.value)
