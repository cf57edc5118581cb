"""Figures of the learning results; the same table gives the same bytes."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from grasptypes.files import write_bytes
from grasptypes.reports.results import constant_rows

MEASURES = {"sim": "angular similarity", "acc": "multilabel accuracy", "prec": "precision"}
LABELLED = {
    "no_task": "(a) no task",
    "task_vector": "(b) task vector",
    "task_in_image": "(c) task in image",
    "ignores_task": "(d) ignores task",
}
OURS, PAPER, CEILING, CONSTANT = "#2a6f97", "#c9a227", "#6c757d", "#b23a48"


def plot_table(table: pd.DataFrame, path: str | Path) -> None:
    """Bars of mean and spread for each model and measure, beside the paper and the ceiling.

    Where the table has no figures of the paper, the best constant answer is drawn instead.

    Args:
        table: of :data:`grasptypes.reports.results.RESULT_SCHEMA`; one row of panels a label
            source.
        path: of the PNG.
    """
    used = table[table["n_folds"] > 0]
    sources = list(dict.fromkeys(used["labels"]))
    figure, panels = plt.subplots(
        len(sources), len(MEASURES), figsize=(10, 3.2 * len(sources)), sharey=True, squeeze=False
    )
    for row, labels in zip(panels, sources, strict=True):
        for axes, (short, title) in zip(row, MEASURES.items(), strict=True):
            _bars(axes, used[used["labels"] == labels], short)
            if not _has_paper(used):
                constant = constant_rows(table, labels)[f"{short}_mean"]
                _steps(axes, constant, CONSTANT, "best constant answer")
            axes.set_title(title, fontsize=10)
        row[0].set_ylabel(f"{labels} labels")
    # The panels share their axis: it must reach down to the lowest bar and its spread.
    lowest = min((used[f"{short}_mean"] - used[f"{short}_sd"]).min() for short in MEASURES)
    panels[0][0].set_ylim(max(0.0, np.floor(lowest * 10) / 10), 1.02)
    handles, names = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncols=3, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.08 / len(sources), 1, 1))
    save(figure, path)


def contact_sheet(pictures: Mapping[str, np.ndarray], path: str | Path, columns: int) -> None:
    """Some pictures of every object, one object after the other.

    Args:
        pictures: object to (N, H, W, 3) uint8; the same N for all.
        columns: objects side by side.
    """
    strips = [np.hstack(list(views)) for views in pictures.values()]
    strips += [np.full_like(strips[0], 255)] * (-len(strips) % columns)
    rows = [np.hstack(strips[start : start + columns]) for start in range(0, len(strips), columns)]
    sheet = Image.fromarray(np.vstack(rows))
    buffer = io.BytesIO()
    sheet.resize((sheet.width // 2, sheet.height // 2), Image.Resampling.LANCZOS).save(
        buffer, "PNG"
    )
    write_bytes(path, buffer.getvalue())


def save(figure: Figure, path: str | Path) -> None:
    """Write a figure as PNG without anything that tells when or by what it was made."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=120, metadata={"Software": None})
    plt.close(figure)
    write_bytes(path, buffer.getvalue())


def _steps(axes: Axes, heights: pd.Series, colour: str, label: str) -> None:
    """A level of its own above each bar."""
    place = np.arange(len(heights))
    axes.hlines(
        heights, place - 0.45, place + 0.45, colors=colour, linestyles="dashed", label=label
    )


def _has_paper(rows: pd.DataFrame) -> bool:
    return bool(rows[[f"paper_{short}" for short in MEASURES]].notna().any(axis=None))


def _bars(axes: Axes, rows: pd.DataFrame, short: str) -> None:
    place = np.arange(len(rows))
    paper = _has_paper(rows)
    axes.bar(
        place - 0.2 * paper,
        rows[f"{short}_mean"],
        0.4 if paper else 0.7,
        yerr=rows[f"{short}_sd"],
        color=OURS,
        label="here",
        capsize=2,
    )
    if paper:
        axes.bar(place + 0.2, rows[f"paper_{short}"], 0.4, color=PAPER, label="paper")
    if f"ceiling_{short}" in rows:
        _steps(axes, rows[f"ceiling_{short}"], CEILING, "ceiling of the labels")
    axes.set_xticks(
        place, [LABELLED[model] for model in rows["model"]], rotation=25, ha="right", fontsize=8
    )
    axes.grid(axis="y", alpha=0.3)
    axes.set_axisbelow(True)
