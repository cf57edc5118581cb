"""A store of the S3 kind, here moto's server on this machine, shares results as a folder does."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import boto3
import pytest
from moto.server import ThreadedMotoServer
from repository import TARGET, Repository, jobs
from verify import checksums

BUCKET = "grasptypes"


@pytest.fixture
def store(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """Address of a server with one empty bucket; its keys are in the environment."""
    for name, value in {
        "AWS_ACCESS_KEY_ID": "test",
        "AWS_SECRET_ACCESS_KEY": "test",
        "AWS_DEFAULT_REGION": "us-east-1",
        "NO_PROXY": "127.0.0.1",
    }.items():
        monkeypatch.setenv(name, value)
    server = ThreadedMotoServer(ip_address="127.0.0.1", port=0)
    server.start()
    host, port = server.get_host_and_port()
    address = f"http://{host}:{port}"
    boto3.client("s3", endpoint_url=address).create_bucket(Bucket=BUCKET)
    yield address
    server.stop()


@pytest.mark.slow
def test_a_clone_that_pulls_from_the_store_has_nothing_to_do(
    changed: Repository, store: str, tmp_path: Path
) -> None:
    changed.dvc("remote", "add", "-d", "store", f"s3://{BUCKET}/results")
    changed.dvc("remote", "modify", "store", "endpointurl", store)
    changed.commit("Remote")
    changed.dvc("push")
    objects = boto3.client("s3", endpoint_url=store).list_objects_v2(Bucket=BUCKET)
    assert objects["KeyCount"] > 20
    changed.git("clone", "-q", ".", str(tmp_path / "clone"))
    clone = Repository(tmp_path / "clone")
    assert not clone.snakemake_is_clean(TARGET)
    clone.dvc("pull")
    assert clone.is_clean()
    assert jobs(clone.dvc("repro")) == {}
    assert checksums(clone.path) == checksums(changed.path)
    assert "in sync" in clone.dvc("status", "--cloud")
