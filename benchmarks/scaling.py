"""Time and memory of the workflow against the number of objects: reports/scaling.csv.

Run from the repository:

    python benchmarks/scaling.py                          # 19, 38 and 76 objects
    python benchmarks/scaling.py --keep --objects 190     # one size more, on top of them

The workflow runs in build/scaling, up to Table I, with the small parameters of
benchmarks/scaling.yaml. Each size adds variants to the objects of the one before, which stay as
they are. Times are processor times of whole calls of Snakemake with all they start, so that other
work on the machine counts little:

- `workflow`: all calls up to this size. It counts what is recomputed at every size (next row) once
  for each, so it is an upper bound of a run from nothing.
- `collecting`: the rules that read all objects: labels, folds, predictors and Table I.
- `plan`: a dry run, which is start-up and the graph of all jobs.

`of_linear` is the time an object over that of the smallest size: growth is at most linear within
10 % where it stays below 1.1. The other rows show the memory of each rule's largest job.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pandas as pd
import pandera.pandas as pa
import yaml

from grasptypes.tables import read_table, write_table
from grasptypes.versions.checkout import copy_checkout
from grasptypes.yaml_files import merge, read_yaml

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "build/scaling"
REPORT = ROOT / "reports/scaling.csv"
TARGET = "reports/table1.csv"
CATALOGUE = 19
KIB_A_MIB = 1024.0
COLLECTING = ("label_grasps", "split_folds", "train_predictor")
SCHEMA = pa.DataFrameSchema(
    {
        "objects": pa.Column(int, pa.Check.ge(CATALOGUE)),
        "part": pa.Column(str),
        "jobs": pa.Column(int, pa.Check.ge(1)),
        "core_s": pa.Column(float, pa.Check.ge(0), nullable=True),
        "max_rss_mib": pa.Column(float, pa.Check.gt(0)),
        "of_linear": pa.Column(float, nullable=True),
    },
    strict=True,
    unique=["objects", "part"],
)


def update_checkout(objects: int) -> None:
    """The checkout with as many objects, those of smaller sizes among them."""
    if objects % CATALOGUE:
        sys.exit(f"error: --objects: {objects} is no multiple of {CATALOGUE}")
    small = read_yaml(ROOT / "benchmarks/scaling.yaml")
    changes = merge(small, {"objects": {"variants": objects // CATALOGUE - 1}})
    overlay = FOLDER.with_suffix(".yaml")
    overlay.parent.mkdir(parents=True, exist_ok=True)
    overlay.write_text(yaml.safe_dump(changes))
    copy_checkout(ROOT, FOLDER, overlay)
    # Laid over, the small parameters' only task would stand beside the others.
    params = read_yaml(FOLDER / "params.yaml") | {"tasks": small["tasks"]}
    (FOLDER / "params.yaml").write_text(yaml.safe_dump(params, sort_keys=False))


def snakemake(*arguments: str) -> tuple[float, float]:
    """Processor time (s) of a call with all it starts, and the memory of its largest process."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    command = [sys.executable, "-m", "snakemake", "--quiet", "all", *arguments, "--", TARGET]
    with open(FOLDER / "scaling.log", "w") as log:
        process = subprocess.Popen(
            command, cwd=FOLDER, env=environment, stdout=log, stderr=subprocess.STDOUT
        )
        _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"error: {' '.join(command)} failed, see {log.name}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / KIB_A_MIB


def rule_rows() -> list[dict[str, Any]]:
    """One row per rule: its jobs, and the memory of the largest."""
    benchmarks, jobs = FOLDER / "logs/benchmarks", []
    for path in sorted(benchmarks.rglob("*.tsv")):
        rule = path.relative_to(benchmarks).parts[0].removesuffix(".tsv")
        memory = pd.read_csv(path, sep="\t", na_values="-")["max_rss"].iloc[0]
        jobs.append({"part": rule, "max_rss_mib": memory})
    grouped = pd.DataFrame(jobs).groupby("part", sort=False)["max_rss_mib"]
    table = grouped.agg(jobs="size", max_rss_mib="max").reset_index()
    return [row for row in table.to_dict("records") if row["max_rss_mib"] > 0]


def measure(objects: int, before_s: float, plan_only: bool) -> list[dict[str, Any]]:
    """All rows of one size.

    Args:
        before_s: processor time of the smaller sizes.
    """
    update_checkout(objects)
    plan_s, plan_mib = snakemake("-n")
    rows = [{"part": "plan", "jobs": 1, "core_s": plan_s, "max_rss_mib": plan_mib}]
    if not plan_only:
        run_s, run_mib = snakemake("-j2")
        kept = rule_rows()
        count = sum(row["jobs"] for row in kept)
        total = {"part": "workflow", "jobs": count, "core_s": before_s + run_s}
        again_s, again_mib = snakemake("-j2", "--forcerun", *COLLECTING)
        made = sum(row["jobs"] for row in kept if row["part"] in COLLECTING)
        again = {"part": "collecting", "jobs": made, "core_s": again_s}
        rows += [total | {"max_rss_mib": run_mib}, again | {"max_rss_mib": again_mib}, *kept]
    return [row | {"objects": objects} for row in rows]


def with_growth(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """The table, with the time an object relative to the smallest size that has the part."""
    table = pd.DataFrame(rows).sort_values("objects", kind="stable", ignore_index=True)
    each = table["core_s"] / table["objects"]
    table["of_linear"] = each / each.groupby(table["part"]).transform("first")
    return table[list(SCHEMA.columns)].round({"core_s": 2, "max_rss_mib": 1, "of_linear": 3})


def main() -> None:
    parser = argparse.ArgumentParser(
        description="Time and memory of the workflow against the number of objects."
    )
    parser.add_argument("--objects", type=int, nargs="+", default=[19, 38, 76])
    parser.add_argument("--keep", action="store_true", help="go on from the sizes there are")
    parser.add_argument("--plan-only", action="store_true", help="measure the dry run alone")
    chosen = parser.parse_args()
    if not chosen.keep:
        shutil.rmtree(FOLDER, ignore_errors=True)
        REPORT.unlink(missing_ok=True)
    for objects in chosen.objects:
        rows = read_table(REPORT, SCHEMA).to_dict("records") if REPORT.exists() else []
        rows = [row for row in rows if row["objects"] != objects]
        smaller = [
            row["core_s"] for row in rows if row["part"] == "workflow" and row["objects"] < objects
        ]
        rows += measure(objects, max(smaller, default=0.0), chosen.plan_only)
        write_table(with_growth(rows), REPORT, SCHEMA)
    sys.stdout.write(REPORT.read_text())


if __name__ == "__main__":
    main()
