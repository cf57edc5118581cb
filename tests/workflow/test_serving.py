"""MLflow's own tools serve the logged models, and say what `grasptypes predict` says."""

import json
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mlflow
import numpy as np
import pytest
from PIL import Image
from repository import Repository

NAME = "simulated_task_vector"
START_S = 60
TYPES = 6


def model_path(repository: Repository) -> str:
    """Folder of the logged model."""
    client = mlflow.MlflowClient(f"sqlite:///{repository.path / 'mlflow.db'}")
    experiment = client.get_experiment_by_name("grasptypes")
    assert experiment is not None
    (model,) = client.search_logged_models([experiment.experiment_id], f"name = '{NAME}'")
    return model.artifact_location.removeprefix("file://")


@pytest.fixture(scope="module")
def photos(complete: Repository, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("photos")
    with zipfile.ZipFile(complete.path / "data/renders/mug.zip") as archive:
        for name in ("000.png", "001.png"):
            archive.extract(name, folder)
    return folder


@pytest.fixture(scope="module")
def answers(complete: Repository, photos: Path) -> dict[str, np.ndarray]:
    """Probabilities (2, 6) by task, from the command line."""
    found = {}
    for task in ("use", "handoff"):
        command = ("grasptypes", "predict", "--image", str(photos), "--task", task, "--json")
        source = {"PYTHONPATH": str(complete.path / "src")}
        said = json.loads(complete.run(sys.executable, "-m", *command, **source))
        found[task] = np.array([list(a["probability"].values()) for a in said["answers"]])
    return found


@pytest.fixture(scope="module")
def address(complete: Repository, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A server of the model on this machine."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = tmp_path_factory.mktemp("server") / "log.txt"
    with log.open("w") as output:
        server = subprocess.Popen(
            [sys.executable, "-m", "mlflow", "models", "serve", "-m", model_path(complete),
             "--env-manager", "local", "-h", "127.0.0.1", "-p", str(port), "-w", "1"],
            env=complete.environment(), stdout=output, stderr=output, start_new_session=True,
        )  # fmt: skip
    url = f"http://127.0.0.1:{port}"
    try:
        await_server(url, server, log)
        yield url
    finally:
        subprocess.run(["kill", "--", f"-{server.pid}"], check=False)
        server.wait(timeout=20)


def await_server(url: str, server: subprocess.Popen, log: Path) -> None:
    for _ in range(START_S * 4):
        assert server.poll() is None, log.read_text()
        try:
            urllib.request.urlopen(f"{url}/ping", timeout=5).close()
            return
        except (urllib.error.URLError, ConnectionError):
            time.sleep(0.25)
    raise AssertionError(log.read_text())


def request(photos: Path, tasks: list[str]) -> dict[str, Any]:
    pictures = [np.asarray(Image.open(path)).tolist() for path in sorted(photos.glob("*.png"))]
    return {"inputs": {"image": pictures, "task": tasks}}


def post(address: str, content: bytes) -> tuple[int, str]:
    headers = {"Content-Type": "application/json"}
    asked = urllib.request.Request(f"{address}/invocations", content, headers)
    try:
        with urllib.request.urlopen(asked, timeout=60) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


def test_the_server_says_what_the_command_says(
    address: str, photos: Path, answers: dict[str, np.ndarray]
) -> None:
    status, text = post(address, json.dumps(request(photos, ["use", "handoff"])).encode())
    assert status == 200, text
    served = np.array(json.loads(text)["predictions"]["probability"])
    assert served.shape == (2, TYPES)
    np.testing.assert_allclose(served, [answers["use"][0], answers["handoff"][1]], atol=1e-5)


@pytest.mark.parametrize(
    ("tasks", "expected"),
    [
        (["use", "fly"], "fly: unknown; allowed: use, handoff"),
        (["use"], "2 images, but 1 tasks"),
    ],
)
def test_the_server_refuses_bad_input(
    address: str, photos: Path, tasks: list[str], expected: str
) -> None:
    status, text = post(address, json.dumps(request(photos, tasks)).encode())
    assert status == 400, text
    assert expected in json.loads(text)["message"]
    assert "Traceback" not in text


@pytest.mark.parametrize(
    "content", [b"no json", b'{"inputs": {"image": [[1, 2]], "task": ["use"]}}']
)
def test_the_server_survives_nonsense(address: str, content: bytes) -> None:
    assert post(address, content)[0] == 400
    urllib.request.urlopen(f"{address}/ping", timeout=5).close()


def test_mlflow_predicts_from_a_file(
    complete: Repository, photos: Path, answers: dict[str, np.ndarray], tmp_path: Path
) -> None:
    (tmp_path / "in.json").write_text(json.dumps(request(photos, ["handoff", "use"])))
    complete.run(
        sys.executable, "-m", "mlflow", "models", "predict", "-m", model_path(complete),
        "-t", "json", "-i", str(tmp_path / "in.json"), "-o", str(tmp_path / "out.json"),
        "--env-manager", "local",
    )  # fmt: skip
    said = json.loads((tmp_path / "out.json").read_text())["predictions"]["probability"]
    np.testing.assert_allclose(said, [answers["handoff"][0], answers["use"][1]], atol=1e-5)
