"""MLflow's own tools serve a logged model, and say what `grasptypes predict` says."""

import json
import os
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path

import mlflow
import numpy as np
import pytest
from learning import ROOT, small_checkout
from PIL import Image

import grasptypes.errors
from grasptypes.__main__ import main
from grasptypes.predictors.weights import WEIGHTS_VARIABLE
from grasptypes.runs.run_records import RunRecord, serving_requirements
from grasptypes.runs.serving import MIN_PX
from grasptypes.runs.tracking import LoggedModel, Store, publish
from grasptypes.yaml_files import read_yaml

# Importing torch and MLflow on a busy machine.
START_S = 90
PICTURES = np.random.default_rng(3).integers(0, 256, (2, 48, 48, 3), dtype=np.uint8)
WIDE = np.random.default_rng(4).integers(0, 256, (1, 40, 80, 3), dtype=np.uint8)
TASKS = ["handoff", "wash"]


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A folder with a predictor and two photos."""
    root = tmp_path_factory.mktemp("checkout")
    small_checkout(root, {})
    for number, picture in enumerate(PICTURES):
        path = root / "photos" / f"{number}.png"
        path.parent.mkdir(exist_ok=True)
        Image.fromarray(picture).save(path)
    return root


@pytest.fixture(scope="module")
def model(checkout):
    """Folder of the model that MLflow has logged."""
    trained = checkout / "models/simulated/task_vector"
    logged = LoggedModel(
        "simulated_task_vector",
        {
            "tensors": trained / "predictor.safetensors",
            "card": trained / "predictor.json",
            "weights": checkout / "random.pth",
        },
        Path(grasptypes.errors.__file__).parent,
        serving_requirements(),
        PICTURES[:1],
        "use",
        6,
    )
    run = RunRecord("key", "simulated task_vector", 1000, 2000, {}, {})
    publish(Store(checkout / "mlflow.db", "test", 60), [run], {"key": ("content", logged)})
    client = mlflow.MlflowClient(f"sqlite:///{checkout / 'mlflow.db'}")
    (found,) = client.search_logged_models([client.get_experiment_by_name("test").experiment_id])
    return found.artifact_location.removeprefix("file://")


@pytest.fixture(scope="module")
def expected(checkout):
    """Probabilities (2, 6) of the photos, each for its task, from the command line."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(WEIGHTS_VARIABLE, str(checkout / "random.pth"))
        answers = [_predicted(checkout, task)[row] for row, task in enumerate(TASKS)]
    return np.array(answers)


def _predicted(checkout, task, folder="photos"):
    written = checkout / "answers.json"
    arguments = ["predict", "--folder", str(checkout), "--image", str(checkout / folder)]
    with written.open("w") as output, pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stdout", output)
        main([*arguments, "--task", task, "--json"])
    answers = json.loads(written.read_text())["answers"]
    return [list(answer["probability"].values()) for answer in answers]


@pytest.fixture(scope="module")
def address(model, tmp_path_factory):
    """A server of the model on this machine."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = tmp_path_factory.mktemp("server") / "log.txt"
    with log.open("w") as output:
        server = subprocess.Popen(
            [*_mlflow("serve", model), "-h", "127.0.0.1", "-p", str(port), "-w", "1"],
            env=_environment(), stdout=output, stderr=output, start_new_session=True,
        )  # fmt: skip
    try:
        _await(f"http://127.0.0.1:{port}/ping", server, log)
        yield f"http://127.0.0.1:{port}/invocations"
    finally:
        os.killpg(server.pid, 15)
        server.wait(timeout=20)


def _mlflow(tool, model):
    return [sys.executable, "-m", "mlflow", "models", tool, "-m", model, "--env-manager", "local"]


def _environment():
    """The code comes with the model, not from this checkout."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    tools = os.pathsep.join([str(Path(sys.executable).parent), kept["PATH"]])
    return kept | {"PATH": tools, "MLFLOW_DISABLE_TELEMETRY": "true"}


def _await(url, server, log):
    deadline = time.monotonic() + START_S
    while time.monotonic() < deadline:
        assert server.poll() is None, log.read_text()
        try:
            urllib.request.urlopen(url, timeout=5).close()
            return
        except OSError:
            time.sleep(0.2)
    raise AssertionError(log.read_text())


def _request(tasks, pictures=PICTURES):
    return json.dumps({"inputs": {"image": pictures.tolist(), "task": tasks}})


def _post(address, content):
    headers = {"Content-Type": "application/json"}
    asked = urllib.request.Request(address, content.encode(), headers)
    try:
        with urllib.request.urlopen(asked, timeout=60) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


def test_the_server_says_what_the_command_says(address, expected):
    status, text = _post(address, _request(TASKS))
    assert status == 200, text
    served = json.loads(text)["predictions"]["probability"]
    np.testing.assert_allclose(served, expected, atol=1e-5)
    assert np.abs(np.diff(expected, axis=0)).max() > 0.01  # pictures and tasks that differ


def test_a_wide_picture_is_padded_as_the_command_pads_it(address, checkout, monkeypatch):
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(checkout / "random.pth"))
    (checkout / "wide").mkdir()
    Image.fromarray(WIDE[0]).save(checkout / "wide/wide.png")
    status, text = _post(address, _request(["use"], WIDE))
    assert status == 200, text
    served = json.loads(text)["predictions"]["probability"]
    np.testing.assert_allclose(served, _predicted(checkout, "use", "wide"), atol=1e-5)


def test_the_least_size_is_that_of_the_command():
    assert read_yaml(ROOT / "params.yaml")["predict"]["photos"]["min_px"] == MIN_PX


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (_request(["use"], WIDE[:, :20]), "image is 80 x 20 pixels; each side needs 32"),
        (_request(TASKS, PICTURES / 255), "values from 0 to 255 are needed"),
        (_request(["use", "fly"]), "fly: unknown; allowed: use, handoff, wash"),
        (_request(["use"]), "2 images, but 1 tasks"),
        ('{"inputs": {"image": [[1, 2]], "task": ["use"]}}', "image"),
        ('{"inputs": {"task": ["use"]}}', "image"),
        ("no json", "JSON"),
    ],
)
def test_the_server_refuses_bad_requests_in_one_message(address, content, message):
    status, text = _post(address, content)
    assert status == 400, text
    assert message in json.loads(text)["message"]
    assert "Traceback" not in text
    assert _post(address, _request(TASKS))[0] == 200


def test_mlflow_predicts_from_a_file(model, expected, tmp_path):
    (tmp_path / "in.json").write_text(_request(TASKS))
    files = ["-t", "json", "-i", str(tmp_path / "in.json"), "-o", str(tmp_path / "out.json")]
    command = [*_mlflow("predict", model), *files]
    called = subprocess.run(command, env=_environment(), capture_output=True, text=True)
    assert called.returncode == 0, called.stderr
    said = json.loads((tmp_path / "out.json").read_text())["predictions"]["probability"]
    np.testing.assert_allclose(said, expected, atol=1e-5)
