"""Wall time of each rule and of the whole, and peak memory, from the records of the last runs."""

from __future__ import annotations

import base64
import json
import os
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd
from benchmarks.figures import Figure, figure

from grasptypes.settings.params import Params

MAIN_JOB = "reports/table1.csv"
BEFORE_LABELS = {"prepare_object", "map_contacts", "synthesize_grasps"}


class Record(NamedTuple):
    """How a file was made."""

    rule: str
    job: int
    """The same for all files of a job."""
    inputs: list[str]
    begun_s: float
    ended_s: float


def measure(settings: Mapping[str, Any], params: Params) -> Iterator[Figure]:
    """All rules and the total, the main job and its targets, memory and the machine's."""
    records = read_records(Path(".snakemake/metadata"))
    whole_s = busy_s(records.values())
    for rule in sorted({record.rule for record in records.values()}):
        time_s = busy_s([record for record in records.values() if record.rule == rule])
        yield figure(f"wall time of {rule}, beside all rules", time_s, "s", whole_s)
    main = ancestors(records, MAIN_JOB)
    after = [record for record in main if record.rule not in BEFORE_LABELS]
    yield figure("wall time of the main job", busy_s(main), "s", settings["aim_main_job_s"])
    # A full run mixes these jobs with the synthesis, so their own times are added up.
    jobs = {(record.rule, record.job): record for record in after}.values()
    after_s = sum(job.ended_s - job.begun_s for job in jobs) / settings["jobs"]
    yield figure("time from grasps to Table I", after_s, "s", settings["aim_after_grasps_s"])
    machine_mb = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**20
    for rule, peak_mb in peaks_mb(Path("logs/benchmarks")).items():
        yield figure(f"peak memory of {rule}", peak_mb, "MB", machine_mb)


def read_records(folder: Path) -> dict[str, Record]:
    """Snakemake's records by the file they are about."""
    records = {}
    for path in folder.rglob("*"):
        if path.is_file():
            # The result's path in base64, split into folders if it is too long for a file name.
            encoded = "".join(part.removeprefix("@") for part in path.relative_to(folder).parts)
            name = base64.urlsafe_b64decode(encoded).decode()
            found = json.loads(path.read_text())
            names = "rule", "job_hash", "input", "starttime", "endtime"
            records[name] = Record(*(found[name] for name in names))
    return records


def ancestors(records: Mapping[str, Record], target: str) -> list[Record]:
    """The records of a file and of everything it was made from."""
    waiting, seen = [target], {}
    while waiting:
        name = waiting.pop()
        if name in records and name not in seen:
            seen[name] = records[name]
            waiting.extend(records[name].inputs)
    return list(seen.values())


def busy_s(records: Collection[Record]) -> float:
    """Seconds in which at least one of the jobs ran, however the runs were spread over days."""
    busy, until = 0.0, 0.0
    for record in sorted(records, key=lambda record: record.begun_s):
        busy += max(0.0, record.ended_s - max(until, record.begun_s))
        until = max(until, record.ended_s)
    return busy


def peaks_mb(folder: Path) -> dict[str, float]:
    """The largest resident memory of a job of each rule, MiB, from Snakemake's benchmarks."""
    peaks: dict[str, float] = {}
    for path in sorted(folder.rglob("*.tsv")):
        rule = path.relative_to(folder).parts[0].removesuffix(".tsv")
        # A job of less than a second ends before it is sampled.
        peak = pd.to_numeric(pd.read_csv(path, sep="\t")["max_rss"], errors="coerce").max()
        if peak > 0:
            peaks[rule] = max(peaks.get(rule, 0.0), float(peak))
    return peaks
