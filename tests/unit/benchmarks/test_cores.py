"""The simulation of other numbers of cores: jobs wait for their inputs and for a free core."""

import pytest
from benchmarks.cores import Job, longest_paths, simulate

NONE = frozenset[str]()
JOBS = {
    "short": Job(1.0, NONE),
    "long": Job(4.0, NONE),
    "after short": Job(2.0, frozenset({"short"})),
    "table": Job(1.0, frozenset({"long", "after short"})),
}


def test_a_path_ends_with_the_table() -> None:
    assert longest_paths(JOBS) == {"short": 4.0, "long": 5.0, "after short": 3.0, "table": 1.0}


@pytest.mark.parametrize(("cores", "seconds"), [(1, 8.0), (2, 5.0), (64, 5.0)])
def test_jobs_wait_for_inputs_and_cores(cores: int, seconds: float) -> None:
    assert simulate(JOBS, cores) == seconds
