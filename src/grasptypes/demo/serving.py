"""The server of the demo page: it answers in memory, keeps nothing and serves this machine only."""

from __future__ import annotations

import base64
import io
import json
import re
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any, ClassVar
from urllib.parse import parse_qs, urlsplit

import numpy as np
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.predictors.general_predictor import TRAINED
from grasptypes.predictors.known_kinds import LOOKS, read_looks
from grasptypes.predictors.known_size import read_size
from grasptypes.predictors.prediction import Predictor
from grasptypes.predictors.shown import Hints, look
from grasptypes.renders.image_parts import read_box

PAGE = Path(__file__).with_name("page.html")
HOST = "127.0.0.1"
# Red for what spoke for a type, blue for what spoke against it.
FOR, AGAINST = (200, 30, 40), (30, 80, 200)


def demo_server(predictor: Predictor, port: int) -> ThreadingHTTPServer:
    """A server of the page on 127.0.0.1; nobody else on the network can ask it.

    Args:
        port: 0 takes a free one.

    Raises:
        OSError: the port is in use.
    """
    tasks = "".join(f"<option>{task}</option>" for task in predictor.card.tasks)
    limit_mb = predictor.params.predict.demo.max_upload_mb
    values = {"tasks": tasks, "limit": f"{limit_mb:g}"}
    text = PAGE.read_text(encoding="utf-8")
    page = re.sub(r"{{(\w+)}}", lambda found: values[found[1]], text).encode()

    own = {"predictor": predictor, "page": page}
    return ThreadingHTTPServer((HOST, port), type("Handler", (_Handler,), own))


class _Handler(BaseHTTPRequestHandler):
    """Sends the page, and answers images that it posts."""

    predictor: ClassVar[Predictor]
    page: ClassVar[bytes]
    timeout = 30  # seconds; a client that sends nothing does not keep a thread

    def do_GET(self) -> None:
        """Send the page."""
        if urlsplit(self.path).path != "/":
            self.send_error(HTTPStatus.NOT_FOUND)
            return
        self._send(HTTPStatus.OK, "text/html; charset=utf-8", self.page)

    def do_POST(self) -> None:
        """Answer an image; `task`, `size` and `box` are in the address."""
        asked = urlsplit(self.path)
        # Another page in the same browser must not use this one.
        if asked.path != "/predict" or not self._from_here():
            self.close_connection = True
            self.send_error(HTTPStatus.FORBIDDEN)
            return
        length, limit_mb = self.headers.get("Content-Length", ""), self._limit_mb()
        if not length.isdecimal() or int(length) > limit_mb * 1e6:
            self.close_connection = True
            said = {"error": f"the image must have at most {limit_mb:g} MB"}
            self._json(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, said)
            return
        content = self.rfile.read(int(length))
        options = {name: values[0] for name, values in parse_qs(asked.query).items()}
        try:
            self._json(HTTPStatus.OK, answered(self.predictor, content, options))
        except InputError as error:
            # The file is one of ours, whose name says nothing.
            where = f"{error.file}: {error.key}" if error.file.startswith("--") else "the image"
            self._json(HTTPStatus.BAD_REQUEST, {"error": f"{where}: {error.message}"})

    def _limit_mb(self) -> float:
        return self.predictor.params.predict.demo.max_upload_mb

    def _from_here(self) -> bool:
        host, port = self.connection.getsockname()[:2]
        address = f"{host}:{port}"
        origin = self.headers.get("Origin", f"http://{address}")
        return self.headers.get("Host") == address and origin == f"http://{address}"

    def _json(self, status: HTTPStatus, content: dict[str, Any]) -> None:
        self._send(status, "application/json", json.dumps(content).encode())

    def _send(self, status: HTTPStatus, kind: str, content: bytes) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_: object) -> None:
        """Say nothing."""


def answered(predictor: Predictor, content: bytes, options: dict[str, str]) -> dict[str, Any]:
    """The answer for an image file, with pictures: what is most alike, and what spoke for a type.

    Args:
        options: `task`, and `size` and `box` as for the command; the latter may be empty.

    Raises:
        InputError: the image or an option cannot be used.
    """
    size_m = read_size(options["size"]) if options.get("size") else ()
    hints = Hints(box=read_box(options["box"]) if options.get("box") else None)
    with NamedTemporaryFile() as file:  # gone when the answer is there
        file.write(content)
        file.flush()
        shown = look(file.name, hints, predictor.params)
    task = predictor.check_task(options.get("task"))
    (answer,) = predictor.answer([shown], task, size_m=size_m)
    picture, heat = predictor.explain(shown, task, size_m=size_m)
    names = [one.name for one in answer.neighbours]
    looks = read_looks(names, TRAINED / LOOKS) if names else []
    return {
        **predictor.describe([answer], task),
        "picture": _address(picture),
        "heat": {name: _address(_heated(picture, layer)) for name, layer in heat.items()},
        "looks": {name: _address(small) for name, small in zip(names, looks, strict=True)},
    }


def _heated(picture: np.ndarray, layer: np.ndarray) -> np.ndarray:
    """The image, tinted most where `layer` (H, W) is farthest from 0."""
    layer = layer / max(float(np.abs(layer).max()), 1e-9)
    tint = np.where(layer[..., None] > 0, FOR, AGAINST)
    amount = 0.75 * np.abs(layer)[..., None]
    return np.asarray((picture * (1 - amount) + tint * amount).astype(np.uint8))


def _address(picture: np.ndarray) -> str:
    """An image (H, W, 3) uint8 as an address that a page can show."""
    buffer = io.BytesIO()
    Image.fromarray(picture).save(buffer, "png")
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode()
