from pathlib import Path

import pytest

from repository import Repository


@pytest.fixture(scope="session")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Repository:
    """The small configuration with nothing computed; not to be changed."""
    return Repository.create(tmp_path_factory.mktemp("fresh") / "repository")


@pytest.fixture
def repository(fresh: Repository, tmp_path: Path) -> Repository:
    """A copy of the small configuration that a test may change."""
    return fresh.copy(tmp_path / "repository")
