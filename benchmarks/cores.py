"""How long the main job would take on other numbers of cores: reports/cores.csv.

Run from a repository in which `snakemake -j2 reports/table1.csv` has run:

    python benchmarks/cores.py

The jobs, what each reads and the time that it took come from Snakemake's records and from
`logs/benchmarks`, so nothing else should run on the machine meanwhile. (The processor times there
are samples, up to 30 s apart, without what follows the last one.) The simulation starts, whenever a
core is free, the ready job with the longest path to Table I. It knows nothing of Snakemake's own
time, of queues, or of cores that slow each other down, so its times are lower bounds.
"""

from __future__ import annotations

import heapq
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import pandas as pd
import pandera.pandas as pa
from snakemake.persistence.file import FilePersistence

from grasptypes.tables import write_table

TARGET, REPORT = "reports/table1.csv", "reports/cores.csv"
CORES = (1, 2, 4, 8, 16, 64)
SCHEMA = pa.DataFrameSchema(
    {
        "cores": pa.Column(int, pa.Check.ge(1)),
        "jobs": pa.Column(int, pa.Check.ge(1)),
        "minutes": pa.Column(float, pa.Check.gt(0)),
        "efficiency": pa.Column(
            float, pa.Check.in_range(0, 1), description="share of the cores' time in use"
        ),
        "critical_path_min": pa.Column(
            float, pa.Check.gt(0), description="of jobs that wait for each other: no run is faster"
        ),
    },
    strict=True,
    unique=["cores"],
)


@dataclass(frozen=True)
class Job:
    """A job of the run: the time that it took, and the jobs whose outputs it reads."""

    seconds: float
    after: frozenset[str]


def read_jobs(root: Path, target: str) -> dict[str, Job]:
    """All jobs behind a file, by the names of their logs."""
    records = FilePersistence(path=root / ".snakemake")
    makers: dict[str, str] = {}
    inputs: dict[str, set[str]] = {}
    todo = [target]
    while todo:
        name = todo.pop()
        record = records._read_record(name)
        if name in makers or record is None:  # None: a file that no job makes
            continue
        job = makers[name] = record["log"][0] if record["log"] else record["rule"]
        inputs.setdefault(job, set()).update(record["input"])
        todo += record["input"]
    return {
        job: Job(_seconds(root, job), frozenset(makers[name] for name in names & makers.keys()))
        for job, names in inputs.items()
    }


def _seconds(root: Path, log: str) -> float:
    """Time that a job took; nothing if it has no benchmark, as those that only gather files."""
    path = root / log.replace("logs/", "logs/benchmarks/", 1).replace(".log", ".tsv")
    if not path.is_file():
        return 0.0
    return float(pd.read_csv(path, sep="\t", na_values="-")["s"].iloc[0])


def longest_paths(jobs: Mapping[str, Job]) -> dict[str, float]:
    """Seconds from the start of each job to the end of the last one that waits for it."""
    waiting: dict[str, list[str]] = {name: [] for name in jobs}
    for name, job in jobs.items():
        for earlier in job.after:
            waiting[earlier].append(name)
    paths: dict[str, float] = {}

    def path(name: str) -> float:
        if name not in paths:
            paths[name] = jobs[name].seconds + max(map(path, waiting[name]), default=0.0)
        return paths[name]

    for name in jobs:
        path(name)
    return paths


def simulate(jobs: Mapping[str, Job], cores: int) -> float:
    """Seconds until all jobs have ended on some cores."""
    paths, done, running, now = longest_paths(jobs), set[str](), list[tuple[float, str]](), 0.0
    todo = sorted(jobs, key=lambda name: (-paths[name], name))
    while todo or running:
        ready = [name for name in todo if jobs[name].after <= done][: cores - len(running)]
        for name in ready:
            heapq.heappush(running, (now + jobs[name].seconds, name))
            todo.remove(name)
        now, ended = heapq.heappop(running)
        done.add(ended)
    return now


def main() -> None:
    jobs = read_jobs(Path(), TARGET)
    if not jobs:
        sys.exit(f"error: {TARGET} has not been made here: snakemake -j2 {TARGET}")
    total, critical = sum(job.seconds for job in jobs.values()), max(longest_paths(jobs).values())
    rows = []
    for cores in CORES:
        seconds = simulate(jobs, cores)
        rows.append((cores, len(jobs), seconds / 60, total / (cores * seconds), critical / 60))
    table = pd.DataFrame(rows, columns=list(SCHEMA.columns)).round(3)
    write_table(table, REPORT, SCHEMA)
    sys.stdout.write(Path(REPORT).read_text())


if __name__ == "__main__":
    main()
