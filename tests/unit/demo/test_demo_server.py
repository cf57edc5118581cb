"""The server of the demo page answers images, refuses what is wrong, and keeps nothing."""

import http.client
import io
import json
import tempfile
import threading
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from tests.unit.settings import PARAMS

from grasptypes.demo.serving import demo_server
from grasptypes.predictors.general_predictor import load_general
from grasptypes.predictors.prediction import Predictor

PICTURE = np.random.default_rng(6).integers(0, 256, (64, 64, 3), dtype=np.uint8)


@pytest.fixture(scope="module")
def server():
    demo = PARAMS.predict.demo.changed(max_upload_mb=0.1)
    params = PARAMS.changed(predict=PARAMS.predict.changed(demo=demo))
    with demo_server(Predictor(load_general(), params), 0) as running:
        thread = threading.Thread(target=running.serve_forever)
        thread.start()
        yield running
        running.shutdown()
        thread.join()


def png():
    buffer = io.BytesIO()
    Image.fromarray(PICTURE).save(buffer, "png")
    return buffer.getvalue()


def ask(server, method, path, content=None, **headers):
    connection = http.client.HTTPConnection(*server.server_address[:2])
    connection.request(method, path, content, headers)
    reply = connection.getresponse()
    return reply.status, reply.read()


def test_an_image_is_answered_with_pictures_and_nothing_is_kept(server):
    before = set(Path(tempfile.gettempdir()).iterdir())
    status, content = ask(server, "POST", "/predict?task=use&size=12cm", png())
    told = json.loads(content)
    assert status == 200
    (answer,) = told["answers"]
    assert answer["size_m"] == [0.12]
    assert set(told["heat"]) == {each["type"] for each in answer["types"]}
    assert set(told["looks"]) == {each["kind"] for each in answer["neighbours"]}
    assert told["picture"].startswith("data:image/png;base64,")
    left = set(Path(tempfile.gettempdir()).iterdir()) - before
    assert not [path for path in left if path.is_file()]


def test_the_page_names_every_task_and_loads_nothing_else(server):
    status, content = ask(server, "GET", "/")
    assert status == 200
    assert b"<option>handoff</option>" in content
    assert b"{{" not in content
    assert b"http" not in content.replace(b"httpx", b"")
    assert ask(server, "GET", "/etc/passwd")[0] == 404


@pytest.mark.parametrize(
    ("path", "content", "headers", "status", "message"),
    [
        ("/predict?task=use", b"no image", {}, 400, b"the image: not an image"),
        ("/predict?task=fly", png(), {}, 400, b"--task: fly: unknown"),
        ("/predict?task=use&size=3km", png(), {}, 400, b"--size: 3km: 'km' is no unit"),
        ("/predict?task=use&box=1,2", png(), {}, 400, b"--box: 1,2: must be"),
        ("/predict?task=use", bytes(200_000), {}, 413, b"at most 0.1 MB"),
        ("/predict?task=use", png(), {"Content-Length": "-1"}, 413, b"at most"),
        ("/other", png(), {}, 403, b""),
        ("/predict?task=use", png(), {"Origin": "http://example.org"}, 403, b""),
        ("/predict?task=use", png(), {"Host": "example.org"}, 403, b""),
    ],
)
def test_what_is_wrong_is_refused(server, path, content, headers, status, message):
    found, said = ask(server, "POST", path, content, **headers)
    assert found == status
    assert message in said
