"""A real store: nothing twice, rebuilt alike, several processes at once, a model that is served."""

import contextlib
import fcntl
import sqlite3
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import mlflow
import numpy as np
import pytest
from learning import random_weights

import grasptypes.runs.tracking
from grasptypes.errors import InputError
from grasptypes.labels.samples import TYPES
from grasptypes.predictors.backbone import KINDS
from grasptypes.predictors.metrics import softmax
from grasptypes.predictors.predictor import Architecture, Heads
from grasptypes.predictors.predictor_files import Card, load_predictor, write_predictor
from grasptypes.runs.run_records import RunRecord
from grasptypes.runs.tracking import KEY_TAG, LoggedModel, Store, publish

CHILDREN = tuple(
    RunRecord(
        f"child{k}",
        f"fold {k}",
        1000,
        2000,
        {"fold": k},
        {"similarity": k / 10},
        {"loss": [3.0, 2.0]},
    )
    for k in range(2)
)
PARENT = RunRecord(
    "parent", "published no_task", 1000, 2000, {"labels": "published"}, {"similarity_mean": 0.05},
    tags={"commit": "abc"}, children=CHILDREN,
)  # fmt: skip


def shown(store):
    """Everything that a store shows, without its own identifiers."""
    client = mlflow.MlflowClient(f"sqlite:///{store.database}")
    experiment = client.get_experiment_by_name(store.experiment)
    runs = client.search_runs([experiment.experiment_id])
    keys = {run.info.run_id: run.data.tags[KEY_TAG] for run in runs}
    return sorted(
        (
            run.data.tags[KEY_TAG],
            keys.get(run.data.tags.get("mlflow.parentRunId")) or "",
            sorted(run.data.params.items()),
            sorted(run.data.metrics.items()),
            run.info.start_time,
            run.info.end_time,
            run.info.status,
        )
        for run in runs
    )


@pytest.fixture(scope="module")
def template(tmp_path_factory):
    """A store with the runs in it; making the tables takes seconds, so it is made once."""
    store = Store(tmp_path_factory.mktemp("store") / "mlflow.db", "test", 60)
    assert publish(store, [PARENT], {}) == 3
    return store


def test_folds_are_children_of_their_model(template):
    rows = {row[0]: row for row in shown(template)}
    assert [rows[key][1] for key in ("parent", "child0", "child1")] == ["", "parent", "parent"]
    assert dict(rows["child1"][3]) == {"similarity": 0.1, "loss": 2.0}
    assert all(row[-1] == "FINISHED" for row in rows.values())


def test_publishing_again_adds_nothing_and_keeps_the_commit(template):
    before = shown(template)
    assert publish(template, [replace(PARENT, tags={"commit": "def"})], {}) == 0
    assert shown(template) == before
    with template.opened() as opened:
        run = opened.find("parent")
        assert run.data.tags["commit"] == "abc"
    client = mlflow.MlflowClient(f"sqlite:///{template.database}")
    with template.opened() as opened:
        child = opened.find("child0").info.run_id
    assert [(m.step, m.value) for m in client.get_metric_history(child, "loss")] == [(1, 3), (2, 2)]


def test_a_deleted_store_is_rebuilt_with_the_same_runs(template, tmp_path):
    again = Store(tmp_path / "mlflow.db", "test", 60)
    publish(again, [PARENT], {})
    assert shown(again) == shown(template)


def test_an_experiment_that_was_deleted_in_the_ui_is_restored(tmp_path):
    store = Store(tmp_path / "mlflow.db", "test", 60)
    assert publish(store, [PARENT], {}) == 3
    client = mlflow.MlflowClient(store.uri)
    client.delete_experiment(client.get_experiment_by_name("test").experiment_id)
    assert publish(store, [PARENT], {}) == 0
    assert len(shown(store)) == 3


def test_an_interrupted_call_is_finished_without_doubling(template):
    begun = replace(PARENT, key="begun", children=())
    with template.opened() as opened:
        client = opened._client
        run = client.create_run(opened.experiment, start_time=1000, tags={KEY_TAG: "begun"})
        opened._write(run.info.run_id, begun, 1000)  # killed before it was marked as finished
    assert publish(template, [begun], {}) == 0
    history = client.get_metric_history(run.info.run_id, "similarity_mean")
    assert len(history) == 1
    client.delete_run(run.info.run_id)


def test_two_processes_on_a_new_file(tmp_path):
    code = (
        "import sys; sys.path[:0] = sys.argv[2:]\n"
        "from test_tracking import PARENT, Store, publish\n"
        "publish(Store(sys.argv[1], 'test', 60), [PARENT], {})\n"
    )
    here = Path(__file__)
    paths = [str(path) for path in (here.parent, here.parents[1], here.parents[3] / "src")]
    command = [sys.executable, "-c", code, str(tmp_path / "mlflow.db"), *paths]
    processes = [subprocess.Popen(command, stderr=subprocess.PIPE) for _ in range(2)]
    assert [(p.communicate()[1][-300:], p.returncode)[1] for p in processes] == [0, 0]
    assert len(shown(Store(tmp_path / "mlflow.db", "test", 60))) == 3


def locked_by_a_publisher(folder):
    lock = (folder / "mlflow.lock").open("w")
    fcntl.flock(lock, fcntl.LOCK_EX)
    return lock


def locked_by_a_writer(folder):
    connection = sqlite3.connect(folder / "mlflow.db")
    connection.execute("BEGIN EXCLUSIVE")
    return connection


def read_only(folder):
    """SQLite needs a journal to write; file modes would not stop an administrator."""
    with contextlib.closing(sqlite3.connect(folder / "mlflow.db")) as database:
        database.execute("CREATE TABLE a (b)")
    (folder / "mlflow.db-journal").mkdir()


def damaged(folder):
    (folder / "mlflow.db").write_bytes(b"no database" * 100)


def out_of_reach(folder):
    folder.rmdir()
    folder.write_text("where the store's folder would be")


@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (locked_by_a_publisher, "another process"),
        (locked_by_a_writer, "locked"),
        (read_only, "disk I/O error|unable to open"),
        (damaged, "not a database"),
        (out_of_reach, "exists|directory"),
    ],
)
def test_a_store_that_cannot_be_written_is_named_at_once(tmp_path, spoil, reason):
    folder = tmp_path / "store"
    folder.mkdir()
    kept = spoil(folder)
    begun = time.monotonic()
    with pytest.raises(InputError, match=rf"mlflow\.db: cannot be written: .*({reason})") as error:
        publish(Store(folder / "mlflow.db", "test", 0.2), [PARENT], {})
    assert time.monotonic() - begun < 5
    assert "\n" not in str(error.value)
    if kept is not None:
        kept.close()


def test_a_logged_model_answers_like_the_predictor(template, tmp_path):
    """It is self-contained: weights, code and signature travel with it."""
    weights = random_weights(tmp_path / "random.pth")
    sizes = Architecture(KINDS["mobilenet_v2"].features, 2, (8, 8, 8), 6)
    shifts = {"use": 10, "handoff": -10}
    card = Card(
        "task_vector", "published", TYPES, tuple(shifts), shifts, sizes,
        weights.backbone, weights.name, 32, "none", "bf16",
    )  # fmt: skip
    files = tmp_path / "predictor.safetensors", tmp_path / "predictor.json"
    write_predictor(Heads(sizes, [("a",)]), None, card, *files)
    pictures = np.random.default_rng(0).integers(0, 256, (3, 40, 40, 3), dtype=np.uint8)
    artifacts = {"tensors": files[0], "card": files[1], "weights": weights.path}
    package = Path(grasptypes.runs.tracking.__file__).parents[1]
    model = LoggedModel("test", artifacts, package, ["torch"], pictures[:1], "use", 6)
    assert publish(template, [PARENT], {PARENT.key: ("content", model)}) == 0
    publish(template, [PARENT], {PARENT.key: ("content", model)})  # not logged twice
    client = mlflow.MlflowClient(f"sqlite:///{template.database}")
    with template.opened() as opened:
        run = opened.find(PARENT.key).info
    assert (run.status, run.end_time) == ("FINISHED", PARENT.end_ms)  # of the training
    experiment = client.get_experiment_by_name("test").experiment_id
    (logged,) = client.search_logged_models([experiment])
    served = mlflow.pyfunc.load_model(logged.model_uri)
    asked = np.array(["use", "handoff", "use"])
    answer = served.predict({"image": pictures, "task": asked})
    assert served.metadata.signature is not None
    assert served.metadata.saved_input_example_info is not None
    predictor = load_predictor(*files, weights)
    for task in shifts:
        rows = asked == task
        expected = softmax(predictor.logits(pictures[rows], task))
        np.testing.assert_allclose(answer["probability"][rows], expected, atol=1e-6)
