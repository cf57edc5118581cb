"""The small configuration computed once by each tool, and a line of print for every test."""

from __future__ import annotations

from pathlib import Path

import pytest
from expected import KEEPERS, KEPT
from repository import Repository


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.slow)


@pytest.fixture(autouse=True)
def _line(request: pytest.FixtureRequest, record_property) -> None:
    record_property("line", (request.function.__doc__ or request.node.name).splitlines()[0])
    record_property("case", request.node.callspec.id if hasattr(request.node, "callspec") else "")


def pytest_report_teststatus(report: pytest.TestReport) -> tuple[str, str, str] | None:
    """One line a test, named by its docstring, in place of a dot."""
    if not (report.when == "call" or report.failed):
        return None
    told = dict(report.user_properties)
    word = "PASS" if report.passed else "FAIL"
    case = f" [{told['case']}]" if told.get("case") else ""
    count = f"{told['count']}, " if "count" in told else ""
    line = f"{word} {told.get('line', report.nodeid)}{case} ({count}{report.duration:.0f} s)\n"
    return report.outcome, line, word


def start(path: Path) -> Repository:
    """The small configuration with nothing computed, but for the tables that git holds."""
    repository = Repository.create(path)
    for name in KEPT:
        (path / name).parent.mkdir(parents=True, exist_ok=True)
        (path / name).write_text("kept\n")
    return repository


@pytest.fixture
def fresh(tmp_path: Path) -> Repository:
    """A repository in which nothing is computed."""
    return start(tmp_path / "fresh")


@pytest.fixture(scope="session")
def by_snakemake(tmp_path_factory: pytest.TempPathFactory) -> tuple[Repository, str]:
    """A repository that Snakemake computed and DVC then recorded, and what DVC printed."""
    repository = start(tmp_path_factory.mktemp("by_snakemake") / "repository")
    repository.snakemake(*KEEPERS)
    repository.snakemake("all")
    output = repository.dvc("repro")
    repository.commit("Results")
    return repository, output


@pytest.fixture(scope="session")
def complete(by_snakemake: tuple[Repository, str]) -> Repository:
    """A computed repository; not to be changed."""
    return by_snakemake[0]


@pytest.fixture
def changed(complete: Repository, tmp_path: Path) -> Repository:
    """A copy of the computed repository that a test may change."""
    return complete.copy(tmp_path / "repository")
