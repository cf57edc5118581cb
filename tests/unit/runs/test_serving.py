"""MLflow's own tools serve a logged model, and say what the predictor says."""

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
from learning import ROOT, random_weights, small_predictor
from test_publishing import RUN, TIMES_MS, store_in

from grasptypes.predictors.predictor_files import load_predictor
from grasptypes.renders.photos import padded
from grasptypes.runs.serving import MIN_PX
from grasptypes.runs.tracking import TrainedModel
from grasptypes.settings.params import read_params

# Importing torch and MLflow on a busy machine.
START_S = 90
PICTURES = np.random.default_rng(3).integers(0, 256, (2, 40, 80, 3), dtype=np.uint8)
TASKS = ["handoff", "wash"]


@pytest.fixture(scope="module")
def logged(tmp_path_factory):
    """Folder of the model that MLflow has logged, and the probabilities (2, 6) it should give."""
    root = tmp_path_factory.mktemp("model")
    weights = random_weights(root / "random.pth")
    small_predictor(root, weights)
    card, tensors = root / "predictor.json", root / "predictor.safetensors"
    model, store = TrainedModel(root, root, tensors, card, TIMES_MS), store_in(root)
    with store.opened():
        run = store.upsert(RUN)
        for _ in range(2):  # not logged twice
            store.log_model(run, model, weights.path, PICTURES[0])
    client = mlflow.MlflowClient(store.uri)
    assert client.get_run(run).info.end_time == TIMES_MS[1]  # of the training
    (found,) = client.search_logged_models([client.get_experiment_by_name("test").experiment_id])
    predictor = load_predictor(tensors, card, weights)
    pairs = zip(PICTURES, TASKS, strict=True)
    logits = [predictor.logits(padded(picture)[None], task)[0] for picture, task in pairs]
    powers = np.exp(logits)
    return found.artifact_location.removeprefix("file://"), powers / powers.sum(1, keepdims=True)


@pytest.fixture(scope="module")
def address(logged, tmp_path_factory):
    """A server of the model on this machine; the code comes with the model."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = tmp_path_factory.mktemp("server") / "log.txt"
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    tools = os.pathsep.join([str(Path(sys.executable).parent), kept["PATH"]])
    command = [sys.executable, "-m", "mlflow", "models", "serve", "-m", logged[0], "-w", "1"]
    with log.open("w") as output:
        server = subprocess.Popen(
            [*command, "--env-manager", "local", "-h", "127.0.0.1", "-p", str(port)],
            env=kept | {"PATH": tools, "MLFLOW_DISABLE_TELEMETRY": "true"},
            stdout=output,
            stderr=output,
            start_new_session=True,
        )
    deadline = time.monotonic() + START_S
    try:
        while True:
            assert server.poll() is None, log.read_text()
            assert time.monotonic() < deadline, log.read_text()
            try:
                urllib.request.urlopen(f"http://127.0.0.1:{port}/ping", timeout=5).close()
                break
            except OSError:
                time.sleep(0.2)
        yield f"http://127.0.0.1:{port}/invocations"
    finally:
        os.killpg(server.pid, 15)
        server.wait(timeout=20)


def request(tasks, pictures=PICTURES):
    return json.dumps({"inputs": {"image": pictures.tolist(), "task": tasks}})


def post(address, content):
    headers = {"Content-Type": "application/json"}
    message = urllib.request.Request(address, content.encode(), headers)
    try:
        with urllib.request.urlopen(message, timeout=60) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


def test_the_server_says_what_the_predictor_says(address, logged):
    status, text = post(address, request(TASKS))
    assert status == 200, text
    np.testing.assert_allclose(json.loads(text)["predictions"]["probability"], logged[1], atol=1e-5)
    assert np.abs(np.diff(logged[1], axis=0)).max() > 0.01  # pictures and tasks that differ


def test_the_least_size_is_that_of_the_command():
    assert read_params(ROOT / "params.yaml").predict.photos.min_px == MIN_PX


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (request(["use"], PICTURES[:1, :20]), "image is 80 x 20 pixels; each side needs 32"),
        (request(TASKS, PICTURES / 255), "values from 0 to 255 are needed"),
        (request(["use", "fly"]), "fly: unknown; allowed: use, handoff, wash"),
        (request(["use"]), "2 images, but 1 tasks"),
        ('{"inputs": {"image": [[1, 2]], "task": ["use"]}}', "image"),
        ('{"inputs": {"task": ["use"]}}', "image"),
        ("no json", "JSON"),
    ],
)
def test_the_server_refuses_bad_requests_in_one_message(address, content, message):
    status, text = post(address, content)
    assert status == 400, text
    assert message in json.loads(text)["message"]
    assert "Traceback" not in text
    assert post(address, request(TASKS))[0] == 200
