"""The small configuration on a real Slurm cluster, interrupted twice, against the local run."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from cluster import Cluster
from repository import TARGET, Repository

# The profile with less patience: this cluster answers at once.
CALL = [sys.executable, "-m", "snakemake", "--profile", "profiles/slurm", "--latency-wait", "5"]
CALL += ["--slurm-init-seconds-before-status-checks", "3", "--no-hooks", TARGET]


@contextmanager
def started(repository: Repository, cluster: Cluster, log: Path) -> Iterator[subprocess.Popen]:
    """Snakemake at work on the cluster; killed in the end, if it still runs."""
    environment = {**repository.environment(), **cluster.environment}
    with open(log, "w") as output:
        run = subprocess.Popen(
            CALL, cwd=repository.path, env=environment, stdout=output, stderr=subprocess.STDOUT
        )
    try:
        yield run
    finally:
        run.send_signal(signal.SIGKILL)
        run.wait()


def wait_for(condition: Callable[[], object], patience_s: float = 300.0) -> None:
    deadline = time.monotonic() + patience_s
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.2)


def object_jobs(cluster: Cluster, states: str) -> list[str]:
    """Numbers of the jobs that run the rules of objects."""
    comments = cluster.jobs(states)
    return [number for number, comment in comments.items() if comment.startswith("rule_object")]


def test_the_table_is_the_same_whatever_is_killed(cluster: Cluster, tmp_path: Path) -> None:
    remote = Repository.create(tmp_path / "remote")
    first, second = tmp_path / "first.log", tmp_path / "second.log"

    # The host that Snakemake runs on goes down, and its jobs with it.
    with started(remote, cluster, first):
        wait_for(lambda: any((remote.path / "data/contact_maps").rglob("*.npz")))
    cluster.ask("scancel", *object_jobs(cluster, "RUNNING"))
    wait_for(lambda: not object_jobs(cluster, "RUNNING,COMPLETING"))

    # Called again, it goes on; then a job is lost, which it submits once more by itself.
    with started(remote, cluster, second) as run:
        wait_for(lambda: any((remote.path / "data/grasps").rglob("*.parquet")))
        cluster.ask("scancel", *object_jobs(cluster, "RUNNING"))
        assert run.wait(900) == 0, second.read_text()

    assert len(object_jobs(cluster, "CANCELLED")) == 2
    assert len(object_jobs(cluster, "COMPLETED")) == 1
    local = Repository.create(tmp_path / "local")
    local.snakemake("--no-hooks", TARGET)
    assert (remote.path / TARGET).read_bytes() == (local.path / TARGET).read_bytes()
    assert remote.snakemake_is_clean()
