"""Cost of the jobs on this machine, from Snakemake's benchmarks, for the report.

``python -m grasptypes.reports.timing`` writes ``build/timing.csv`` and ``build/timing.png``. Costs
differ between runs, so nothing that is versioned may depend on them. Snakemake's processor times
are left out: they are samples up to 30 s apart, without what follows the last one.
"""

from __future__ import annotations

import logging
from pathlib import Path

import pandas as pd
import pandera.pandas as pa
from matplotlib.figure import Figure

from grasptypes.labels.label_pictures import save_figure
from grasptypes.tables import write_table

BENCHMARKS, TARGET = Path("logs/benchmarks"), Path("build")

TIMING_SCHEMA = pa.DataFrameSchema(
    {
        "rule": pa.Column(str, unique=True),
        "jobs": pa.Column(int, pa.Check.ge(1)),
        "wall_s": pa.Column(float, pa.Check.ge(0), description="sum over the jobs"),
        "longest_s": pa.Column(float, pa.Check.ge(0), description="wall time of one job"),
        "memory_mb": pa.Column(float, pa.Check.ge(0), nullable=True, description="of the largest"),
    },
    strict=True,
    ordered=True,
)

logger = logging.getLogger(__name__)


def read_timing(folder: str | Path) -> pd.DataFrame:
    """Cost of each rule, the most expensive first: a table of `TIMING_SCHEMA`, empty without files.

    Args:
        folder: folder with files ``<rule>.tsv`` and ``<rule>/<job>.tsv``.
    """
    folder = Path(folder)
    jobs = [
        pd.read_csv(path, sep="\t", na_values="-").assign(
            rule=path.relative_to(folder).parts[0].removesuffix(".tsv")
        )
        for path in sorted(folder.rglob("*.tsv"))
    ]
    if not jobs:
        return pd.DataFrame(columns=list(TIMING_SCHEMA.columns))
    rules = pd.concat(jobs).groupby("rule")
    table = rules.agg(
        jobs=("s", "size"),
        wall_s=("s", "sum"),
        longest_s=("s", "max"),
        memory_mb=("max_rss", "max"),
    ).reset_index()
    return table.sort_values("wall_s", ascending=False, ignore_index=True)


def draw_timing(table: pd.DataFrame) -> Figure:
    """Time and memory, one bar per rule.

    Args:
        table: of `TIMING_SCHEMA`.
    """
    figure = Figure(figsize=(10, 1.4 + 0.34 * len(table)), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True, width_ratios=(3, 2))
    places = pd.Series(range(len(table)), dtype=float)
    names = [f"{row.rule} ({row.jobs})" for row in table.itertuples()]
    wall = left.barh(places, table["wall_s"], 0.6, color="#2a6f97")
    left.bar_label(wall, [_time(seconds) for seconds in table["wall_s"]], padding=3, fontsize=7.5)
    left.set_yticks(places, names)
    left.invert_yaxis()
    left.set_xlabel("seconds, sum over the jobs (their number beside the rule)")
    memory = right.barh(places, table["memory_mb"], 0.6, color="#c9a227")
    right.bar_label(memory, fmt="%.0f", padding=3, fontsize=7.5)
    right.set_xlabel("MB, the largest job")
    for axes in (left, right):
        axes.tick_params(labelsize="small")
        axes.margins(x=0.2, y=0.01)
    return figure


def _time(seconds: float) -> str:
    if seconds < 60:
        return f"{seconds:.1f} s"
    return f"{seconds // 60:.0f} min {seconds % 60:.0f} s"


def main() -> None:
    """Write table and figure of the current folder's benchmarks; remove old ones without any."""
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    table = read_timing(BENCHMARKS)
    files = TARGET / "timing.csv", TARGET / "timing.png"
    if table.empty:
        for path in files:
            path.unlink(missing_ok=True)
        logger.info("%s holds no benchmarks: nothing was computed on this machine", BENCHMARKS)
        return
    write_table(table, files[0], TIMING_SCHEMA)
    save_figure(draw_timing(table), files[1])


if __name__ == "__main__":
    main()
