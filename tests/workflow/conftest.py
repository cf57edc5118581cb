import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from filelock import FileLock
from repository import Repository


@pytest.fixture(scope="session")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Repository:
    """The small configuration with nothing computed; not to be changed."""
    return Repository.create(tmp_path_factory.mktemp("fresh") / "repository")


@pytest.fixture
def repository(fresh: Repository, tmp_path: Path) -> Repository:
    """A copy of the small configuration that a test may change."""
    return fresh.copy(tmp_path / "repository")


@pytest.fixture(scope="session")
def complete(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Repository:
    """The small configuration, computed by Snakemake and recorded by DVC; not to be changed.

    Test processes share one: the first builds it, the others wait.
    """
    shared = tmp_path_factory.getbasetemp()
    if hasattr(request.config, "workerinput"):  # each process has a folder in the run's own
        shared = shared.parent
    with FileLock(shared / "complete.lock"):
        repository = Repository(shared / "complete")
        if not (shared / "complete.done").exists():
            repository = Repository.create(shared / "complete")
            repository.snakemake("all")
            repository.dvc("repro")
            repository.commit("Results")
            (shared / "complete.done").touch()
    return repository


@pytest.fixture
def changed(complete: Repository, tmp_path: Path) -> Repository:
    """A copy of the computed repository that a test may change."""
    return complete.copy(tmp_path / "repository")


@pytest.fixture
def mount() -> Iterator[Callable[..., None]]:
    """`mount` with arguments; the last one is the place, which is freed after the test."""
    places: list[str] = []

    def run(*arguments: str) -> None:
        done = subprocess.run(["mount", *arguments], capture_output=True, text=True, check=False)
        if done.returncode:
            pytest.skip(f"cannot mount here: {done.stderr.strip()}")
        places.append(arguments[-1])

    yield run
    for place in reversed(dict.fromkeys(places)):
        subprocess.run(["umount", "-l", place], capture_output=True, check=False)
