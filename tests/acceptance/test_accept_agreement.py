"""(a) to (c), (f): whoever computed, and wherever the files come from, both tools agree."""

from __future__ import annotations

import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import boto3
import pytest
import yaml
from expected import KEEPERS
from repository import Repository, jobs

BUCKET = "grasptypes-results"
KEYS = {
    "AWS_ACCESS_KEY_ID": "key",
    "AWS_SECRET_ACCESS_KEY": "secret",
    "AWS_DEFAULT_REGION": "us-east-1",
}


def test_a_snakemake_first(by_snakemake: tuple[Repository, str]) -> None:
    """(a) snakemake, then dvc repro: no job, the lock is written, both have nothing to do"""
    repository, output = by_snakemake
    assert jobs(output) == {}, output
    assert set(yaml.safe_load((repository.path / "dvc.lock").read_text())["stages"]) == {
        "objects", "grasps", "renders", "predictors", "reports",
    }  # fmt: skip
    assert repository.is_clean()


def test_b_dvc_first(complete: Repository, fresh: Repository) -> None:
    """(b) dvc repro from nothing: both have nothing to do, and the results are the same bytes"""
    everything = fresh.planned("all")
    made = jobs(fresh.dvc("repro"))
    del everything["all"]
    assert {rule: made[rule] for rule in everything} == everything
    assert fresh.is_clean()
    # No stage asks for what is measured with the user's own data, but a figure of it is an out.
    fresh.snakemake(*KEEPERS)
    fresh.dvc("repro")
    assert results(fresh) == results(complete)


def results(repository: Repository) -> dict[str, str]:
    """Checksums of all that the lock names, but for Snakemake's records, which hold times."""
    stages = yaml.safe_load((repository.path / "dvc.lock").read_text())["stages"]
    outs = {out["path"]: out["md5"] for stage in stages.values() for out in stage.get("outs", [])}
    del outs[".snakemake/metadata"]
    return outs


@pytest.fixture
def s3() -> Iterator[str]:
    """A local server that speaks S3; yields its address."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    server = Path(sys.executable).parent / "moto_server"
    command = [str(server), "-H", "127.0.0.1", "-p", str(port)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        address = f"http://127.0.0.1:{port}"
        client = boto3.client(
            "s3",
            endpoint_url=address,
            region_name=KEYS["AWS_DEFAULT_REGION"],
            aws_access_key_id=KEYS["AWS_ACCESS_KEY_ID"],
            aws_secret_access_key=KEYS["AWS_SECRET_ACCESS_KEY"],
        )
        for _ in range(100):
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    break
            time.sleep(0.1)
        client.create_bucket(Bucket=BUCKET)
        yield address
        process.kill()


def clone_and_pull(repository: Repository, path: Path, **keys: str) -> Repository:
    repository.commit("Remote")
    repository.run("dvc", "push", **keys)
    repository.git("clone", "-q", ".", str(path))
    clone = Repository(path)
    clone.run("dvc", "pull", **keys)
    return clone


def test_c_local_remote(changed: Repository, tmp_path: Path) -> None:
    """(c) fresh clone and dvc pull from a folder: both have nothing to do"""
    changed.dvc("remote", "add", "-d", "store", str(tmp_path / "store"))
    clone = clone_and_pull(changed, tmp_path / "clone")
    assert clone.is_clean()
    assert jobs(clone.snakemake("all")) == {}
    assert jobs(clone.dvc("repro")) == {}


def test_c_s3_remote(changed: Repository, tmp_path: Path, s3: str) -> None:
    """(c) fresh clone and dvc pull from S3: both have nothing to do"""
    changed.dvc("remote", "add", "-d", "store", f"s3://{BUCKET}/store")
    changed.dvc("remote", "modify", "store", "endpointurl", s3)
    clone = clone_and_pull(changed, tmp_path / "clone", **KEYS)
    assert clone.is_clean()
    assert jobs(clone.dvc("repro")) == {}


def test_c_without_pull(changed: Repository, tmp_path: Path) -> None:
    """(c) fresh clone without dvc pull: its tables lie there, and all is computed nevertheless"""
    changed.git("clone", "-q", ".", str(tmp_path / "clone"))
    clone = Repository(tmp_path / "clone")
    assert (clone.path / "reports/table1.csv").exists()
    assert clone.planned("all") == changed.planned("all", "--forceall")


def test_c_part_of_the_data(changed: Repository) -> None:
    """(c) tables and records without the data behind them: nothing to do for the tables"""
    for folder in ("data/objects", "data/renders", "data/features", "models"):
        shutil.rmtree(changed.path / folder)
    assert changed.snakemake_is_clean()


def test_f_branches(changed: Repository) -> None:
    """(f) git checkout and dvc checkout of another branch and back: both have nothing to do"""
    changed.git("checkout", "-q", "-b", "other")
    changed.set_param("renders.sheet.views", 2)
    changed.snakemake("all")
    changed.dvc("repro")
    changed.commit("Another sheet")
    for branch in ("main", "other"):
        changed.git("checkout", "-q", branch)
        changed.dvc("checkout")
        assert changed.is_clean(), branch
        assert jobs(changed.dvc("repro")) == {}
