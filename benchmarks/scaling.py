"""Time and memory of the workflow against the number of objects: reports/scaling.csv.

Run from the repository, best on an idle machine:

    python benchmarks/scaling.py                  # 19, 38 and 76 objects
    python benchmarks/scaling.py --objects 190    # adds or replaces the rows of one size

Each size runs from nothing to Table I in a folder of its own below build/scaling, with the small
parameters of benchmarks/scaling.yaml. `workflow` is the processor time of the whole run, with
Snakemake's own; `plan` is that of a dry run: start-up and the graph of all jobs. The other rows
are the seconds on the clock of one rule's jobs, summed, and the memory of the largest. `of_linear`
is the time an object over that of the smallest size: growth is at most linear within 10 % where it
is below 1.1.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pandera.pandas as pa
import yaml

from grasptypes.params import merge, read_yaml
from grasptypes.tables import read_table, write_table
from grasptypes.versions.checkout import copy_checkout

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "build/scaling"
REPORT = ROOT / "reports/scaling.csv"
TARGET = "reports/table1.csv"
CATALOGUE = 19
KIB_A_MIB = 1024.0
SCHEMA = pa.DataFrameSchema(
    {
        "objects": pa.Column(int, pa.Check.ge(CATALOGUE)),
        "part": pa.Column(str),
        "jobs": pa.Column(int, pa.Check.ge(1)),
        "time_s": pa.Column(float, pa.Check.ge(0)),
        "max_rss_mib": pa.Column(float, pa.Check.gt(0)),
        "of_linear": pa.Column(float, nullable=True),
    },
    strict=True,
    unique=["objects", "part"],
)


def fresh_checkout(objects: int) -> Path:
    """A checkout with as many objects and nothing computed."""
    if objects % CATALOGUE:
        sys.exit(f"error: --objects: {objects} is no multiple of {CATALOGUE}")
    folder = FOLDER / str(objects)
    shutil.rmtree(folder, ignore_errors=True)
    small = read_yaml(ROOT / "benchmarks/scaling.yaml")
    changes = merge(small, {"objects": {"variants": objects // CATALOGUE - 1}})
    overlay = FOLDER / f"{objects}.yaml"
    overlay.parent.mkdir(parents=True, exist_ok=True)
    overlay.write_text(yaml.safe_dump(changes))
    copy_checkout(ROOT, folder, overlay)
    # Laid over, the small parameters' only task would stand beside the others.
    params = read_yaml(folder / "params.yaml") | {"tasks": small["tasks"]}
    (folder / "params.yaml").write_text(yaml.safe_dump(params, sort_keys=False))
    return folder


def snakemake(folder: Path, *arguments: str) -> tuple[float, float]:
    """Processor time (s) of a call with all it starts, and the memory of its largest process."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    command = [sys.executable, "-m", "snakemake", "--quiet", "all", *arguments, TARGET]
    with open(folder / "scaling.log", "w") as log:
        process = subprocess.Popen(
            command, cwd=folder, env=environment, stdout=log, stderr=subprocess.STDOUT
        )
        _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"error: {' '.join(command)} failed, see {log.name}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / KIB_A_MIB


def rule_rows(folder: Path) -> list[dict]:
    """One row a rule: its jobs, their seconds, and the memory of the largest."""
    benchmarks, jobs = folder / "logs/benchmarks", []
    for path in sorted(benchmarks.rglob("*.tsv")):
        rule = path.relative_to(benchmarks).parts[0].removesuffix(".tsv")
        job = pd.read_csv(path, sep="\t", na_values="-").iloc[0]
        jobs.append({"part": rule, "time_s": job["s"], "max_rss_mib": job["max_rss"]})
    grouped = pd.DataFrame(jobs).groupby("part", sort=False)
    table = grouped.agg(
        jobs=("time_s", "size"), time_s=("time_s", "sum"), max_rss_mib=("max_rss_mib", "max")
    )
    return table.reset_index().to_dict("records")


def measure(objects: int, plan_only: bool) -> pd.DataFrame:
    """All rows of one size."""
    folder = fresh_checkout(objects)
    plan_s, plan_mib = snakemake(folder, "-n")
    rows = [{"part": "plan", "jobs": 1, "time_s": plan_s, "max_rss_mib": plan_mib}]
    if not plan_only:
        total_s, total_mib = snakemake(folder, "-j2")
        jobs = rule_rows(folder)
        count = sum(row["jobs"] for row in jobs)
        rows.append(
            {"part": "workflow", "jobs": count, "time_s": total_s, "max_rss_mib": total_mib}
        )
        rows += jobs
    return pd.DataFrame(rows).assign(objects=objects, of_linear=float("nan"))


def with_growth(table: pd.DataFrame) -> pd.DataFrame:
    """The table with the time an object relative to the smallest size that has the part."""
    table = table.sort_values("objects", kind="stable", ignore_index=True)
    each = table["time_s"] / table["objects"]
    table["of_linear"] = each / each.groupby(table["part"]).transform("first")
    return table[list(SCHEMA.columns)].round({"time_s": 2, "max_rss_mib": 1, "of_linear": 3})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--objects", type=int, nargs="+", default=[19, 38, 76])
    parser.add_argument("--plan-only", action="store_true", help="measure the dry run alone")
    chosen = parser.parse_args()
    for objects in chosen.objects:
        found = measure(objects, chosen.plan_only)
        if REPORT.exists():
            known = read_table(REPORT, SCHEMA)
            found = pd.concat([known[known["objects"] != objects], found])
        write_table(with_growth(found), REPORT, SCHEMA)
    sys.stdout.write(REPORT.read_text())


if __name__ == "__main__":
    main()
