"""The authors' table, named by URL and checksum, is fetched by a job of the workflow."""

import functools
import hashlib
import http.server
import threading

import pytest
from repository import Repository

from grasptypes.labels.published_source import FETCHED, PUBLISHED

CONTENT = b"Index,Object\n"
SHA256 = hashlib.sha256(CONTENT).hexdigest()


@pytest.fixture
def url(tmp_path):
    """A host on this machine that holds the table."""
    (tmp_path / "table.csv").write_bytes(CONTENT)
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(tmp_path))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/table.csv"
        server.shutdown()


def test_it_is_fetched_once_and_only_with_the_right_checksum(repository: Repository, url) -> None:
    fetched = repository.path / FETCHED

    def fetch(checksum: str) -> str:
        named = {PUBLISHED: f"{url}#sha256={checksum}"}
        return repository.run("snakemake", "-j1", FETCHED, check=False, **named)

    wrong = fetch("0" * 64)
    assert f"error: {PUBLISHED}: {url} has the SHA-256 {SHA256} instead of 0000" in wrong
    assert not fetched.exists()
    fetch(SHA256)
    assert fetched.read_bytes() == CONTENT
    assert "Nothing to be done" in fetch(SHA256)
