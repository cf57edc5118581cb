"""The figure of Table I or II: bars for each model and measure."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.reports.figures import (
    CEILING,
    CONSTANT,
    CONSTANT_LABEL,
    MEASURES,
    OURS,
    PAPER,
    add_legend,
    label_sources,
    name_models,
    rows_of_panels,
)
from grasptypes.reports.results import PAPER_COLUMNS, constant_rows

# End of the axes, and the share of their height for the numbers at the base of the bars.
TOP, FOOT = 1.02, 0.2


def draw_table(table: pd.DataFrame) -> Figure:
    """Bars of mean and spread for each model and measure, with the paper's figures and the ceiling.

    If the table has no figures from the paper, the constant answer of the others is drawn instead.

    Args:
        table: of `results.RESULT_SCHEMA`; one row of panels per label source.
    """
    used = table[table["n_folds"] > 0]
    sources = label_sources(used)
    figure = Figure(figsize=(13, 3.2 * len(sources)))
    panels = rows_of_panels(sources, len(MEASURES), figure, sharey=True)
    for labels, row in panels.items():
        for axes, (short, title) in zip(row, MEASURES.items(), strict=True):
            _bars(axes, used[used["labels"] == labels], short)
            if not _has_paper(used):
                constant = constant_rows(table, labels)[f"{short}_mean"]
                _steps(axes, constant, CONSTANT, CONSTANT_LABEL)
            axes.set_title(title, fontsize=10)
        row[0].set_ylabel(f"{labels} labels")
    figure.axes[0].set_ylim(_bottom(used), TOP)
    add_legend(figure, loc="lower center", ncols=3, fontsize=9)
    figure.tight_layout(rect=(0, 0.08 / len(sources), 1, 1))
    return figure


def _bottom(rows: pd.DataFrame) -> float:
    """Start of the shared axis: below all bars, spreads, and the numbers at their base."""
    lows = [rows[f"{short}_mean"] - rows[f"{short}_sd"] for short in MEASURES]
    lows += [rows[name] for name in PAPER_COLUMNS]
    lowest = float(np.nanmin(np.concatenate(lows)))
    return max(0.0, float(np.floor((lowest - FOOT * TOP) / (1 - FOOT) * 10) / 10))


def _steps(axes: Axes, heights: pd.Series, colour: str, label: str) -> None:
    """A separate level above each bar."""
    place = np.arange(len(heights))
    axes.hlines(
        heights, place - 0.45, place + 0.45, colors=colour, linestyles="dashed", label=label
    )


def _numbers(axes: Axes, places: np.ndarray, texts: list[str], colour: str) -> None:
    """Numbers at the base of bars."""
    foot = axes.get_xaxis_transform()
    for place, text in zip(places, texts, strict=True):
        number = axes.text(place, 0.03, text, transform=foot, ha="center", va="bottom")
        number.set(color=colour, rotation=90, fontsize=7.5)


def _has_paper(rows: pd.DataFrame) -> bool:
    return bool(rows[list(PAPER_COLUMNS)].notna().any(axis=None))


def _bars(axes: Axes, rows: pd.DataFrame, short: str) -> None:
    place = np.arange(len(rows))
    paper = f"paper_{short}" in rows and _has_paper(rows)
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
        figures = rows[f"paper_{short}"]
        axes.bar(place + 0.2, figures, 0.4, color=PAPER, label="paper")
        texts = ["" if np.isnan(figure) else f"{figure:.2f}" for figure in figures]
        _numbers(axes, place + 0.2, texts, "black")
    if f"ceiling_{short}" in rows:
        _steps(axes, rows[f"ceiling_{short}"], CEILING, "ceiling of the labels")
    name_models(axes, list(rows["model"]), fontsize=8)
    axes.grid(axis="y", alpha=0.3)
    axes.set_axisbelow(True)
