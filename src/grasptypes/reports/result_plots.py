"""Figures of the learning results; the same table gives the same bytes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.labels.label_pictures import save_figure
from grasptypes.reports.results import constant_rows

MEASURES = {"sim": "angular similarity", "acc": "multilabel accuracy", "prec": "precision"}
LABELLED = {
    "no_task": "(a) no task",
    "task_vector": "(b) task vector",
    "task_in_image": "(c) task in image",
    "ignores_task": "(d) ignores task",
}
CONSTANT_LABEL = "constant answer fitted to the other objects"
OURS, PAPER, CEILING, CONSTANT = "#2a6f97", "#c9a227", "#6c757d", "#b23a48"
# End of the axes, and the share of their height that the numbers at the feet of the bars take.
TOP, FOOT = 1.02, 0.2


def plot_table(table: pd.DataFrame, path: str | Path) -> None:
    """Bars of mean and spread for each model and measure, beside the paper and the ceiling.

    Where the table has no figures of the paper, the constant answer of the others is drawn instead.

    Args:
        table: of :data:`grasptypes.reports.results.RESULT_SCHEMA`; one row of panels a label
            source.
        path: of the PNG.
    """
    used = table[table["n_folds"] > 0]
    sources = list(dict.fromkeys(used["labels"]))
    figure = Figure(figsize=(10, 3.2 * len(sources)))
    panels = figure.subplots(len(sources), len(MEASURES), sharey=True, squeeze=False)
    for row, labels in zip(panels, sources, strict=True):
        for axes, (short, title) in zip(row, MEASURES.items(), strict=True):
            _bars(axes, used[used["labels"] == labels], short)
            if not _has_paper(used):
                constant = constant_rows(table, labels)[f"{short}_mean"]
                _steps(axes, constant, CONSTANT, CONSTANT_LABEL)
            axes.set_title(title, fontsize=10)
        row[0].set_ylabel(f"{labels} labels")
    panels[0][0].set_ylim(_bottom(used), TOP)
    handles, names = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncols=3, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.08 / len(sources), 1, 1))
    save_figure(figure, path)


def _bottom(rows: pd.DataFrame) -> float:
    """Where the shared axis starts: below all bars and spreads, and the numbers at their feet."""
    lows = [rows[f"{short}_mean"] - rows[f"{short}_sd"] for short in MEASURES]
    lows += [rows[f"paper_{short}"] for short in MEASURES]
    lowest = float(np.nanmin(np.concatenate(lows)))
    return max(0.0, float(np.floor((lowest - FOOT * TOP) / (1 - FOOT) * 10) / 10))


def _steps(axes: Axes, heights: pd.Series, colour: str, label: str) -> None:
    """A level of its own above each bar."""
    place = np.arange(len(heights))
    axes.hlines(
        heights, place - 0.45, place + 0.45, colors=colour, linestyles="dashed", label=label
    )


def _numbers(axes: Axes, places: np.ndarray, texts: list[str], colour: str) -> None:
    """Numbers at the feet of bars."""
    foot = axes.get_xaxis_transform()
    for place, text in zip(places, texts, strict=True):
        number = axes.text(place, 0.03, text, transform=foot, ha="center", va="bottom")
        number.set(color=colour, rotation=90, fontsize=7.5)


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
    _numbers(axes, place - 0.2 * paper, [f"{mean:.3f}" for mean in rows[f"{short}_mean"]], "white")
    if paper:
        axes.bar(place + 0.2, rows[f"paper_{short}"], 0.4, color=PAPER, label="paper")
        _numbers(axes, place + 0.2, [f"{mean:.2f}" for mean in rows[f"paper_{short}"]], "black")
    if f"ceiling_{short}" in rows:
        _steps(axes, rows[f"ceiling_{short}"], CEILING, "ceiling of the labels")
    axes.set_xticks(
        place, [LABELLED[model] for model in rows["model"]], rotation=25, ha="right", fontsize=8
    )
    axes.grid(axis="y", alpha=0.3)
    axes.set_axisbelow(True)
