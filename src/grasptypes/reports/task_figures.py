"""Figures of the paper's analysis of the labels; the same table gives the same bytes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.reports.figures import CEILING, OURS, PAPER
from grasptypes.reports.task_analysis import PAPER as PAPER_NUMBERS
from grasptypes.reports.task_analysis import share_changes

# Shares that change by more have the darkest colour.
LARGEST = 0.5


def draw_analysis(table: pd.DataFrame) -> Figure:
    """Types, similarity of the tasks and label noise of every object; a row per label source.

    Args:
        table: of `task_analysis.ANALYSIS_SCHEMA`.
    """
    sources = list(dict.fromkeys(table["labels"]))
    most = table.groupby("labels").size().max()
    figure = Figure(figsize=(13, 1.6 + 0.24 * most * len(sources)), layout="constrained")
    panels = figure.subplots(len(sources), 3, squeeze=False)
    for row, labels in zip(panels, sources, strict=True):
        rows = table[table["labels"] == labels]
        _types(row[0], rows)
        titles = ("do the tasks differ?", "label noise: sessions drawn again")
        pairs = (
            {"task_similarity": "two tasks", "chance_similarity": "dealt at random"},
            {"noise_frequencies": "frequencies", "noise_sets": "sets of types"},
        )
        for axes, title, shown in zip(row[1:], titles, pairs, strict=True):
            _dots(axes, rows, shown)
            axes.set_title(title, fontsize="medium")
        row[0].set_ylabel(f"{labels} labels", fontsize="large")
    return figure


def _types(axes: Axes, rows: pd.DataFrame) -> None:
    places = np.arange(len(rows))
    for offset, name, colour, label in (
        (-0.2, "types", OURS, "of a task"),
        (0.2, "differing", "#8ecae6", "of some tasks"),
    ):
        mean = rows[name].mean()
        axes.barh(places + offset, rows[name], 0.38, color=colour, label=f"{label}: {mean:.2f}")
        axes.axvline(mean, color=colour, linewidth=1.2)
    for number in PAPER_NUMBERS.values():
        axes.axvline(number, color=PAPER, linewidth=1.5, linestyle="--")
    axes.plot([], [], color=PAPER, linestyle="--", label="paper: 3.5 and 1.1")
    _objects(axes, rows)
    axes.set_xlim(0, 6)
    axes.set_xlabel("grasp types; lines: means", fontsize="small")
    axes.set_title("types of a pair of object and task", fontsize="medium")


def _dots(axes: Axes, rows: pd.DataFrame, shown: Mapping[str, str]) -> None:
    places = np.arange(len(rows))
    ends = rows[list(shown)].to_numpy()
    axes.hlines(places, ends.min(axis=1), ends.max(axis=1), color=CEILING, alpha=0.4)
    for (name, label), colour in zip(shown.items(), (OURS, PAPER), strict=True):
        mean = rows[name].mean()
        axes.plot(rows[name], places, "o", color=colour, label=f"{label}: {mean:.2f}")
        axes.axvline(mean, color=colour, linewidth=1.2)
    _objects(axes, rows)
    axes.set_xlim(min(0.3, np.floor(ends.min() * 10) / 10), 1.02)
    axes.set_xlabel("angular similarity; lines: means", fontsize="small")


def _objects(axes: Axes, rows: pd.DataFrame) -> None:
    axes.set_yticks(np.arange(len(rows)), [name.replace("_", " ") for name in rows["object"]])
    axes.tick_params(labelsize="small")
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.grid(axis="x", alpha=0.3)
    axes.set_axisbelow(True)
    below: dict[str, Any] = {
        "loc": "upper center",
        "bbox_to_anchor": (0.5, -0.09),
        "frameon": False,
    }
    axes.legend(**below, ncols=3, fontsize=8, columnspacing=0.8, handletextpad=0.4, handlelength=1)


def draw_changes(samples: Mapping[str, pd.DataFrame]) -> Figure:
    """Heat maps of the change of each type's share between tasks; a panel per source and task.

    Args:
        samples: label source to its table of `samples.SAMPLE_SCHEMA`.
    """
    shown = [
        (f"{labels} labels\n{title}", change)
        for labels, table in samples.items()
        for title, change in share_changes(table).items()
    ]
    most = max(len(change) for _, change in shown)
    figure = Figure(figsize=(1.6 + 4.6 * len(shown), 2.0 + 0.32 * most), layout="constrained")
    panels = figure.subplots(1, len(shown), squeeze=False)[0]
    for axes, (title, change) in zip(panels, shown, strict=True):
        numbers = change.to_numpy()
        image = axes.imshow(numbers, cmap="RdBu_r", vmin=-LARGEST, vmax=LARGEST, aspect="auto")
        names = [name.removeprefix("count_").replace("_", "\n") for name in change.columns]
        axes.set_xticks(range(len(names)), names)
        axes.set_yticks(range(len(change)), [name.replace("_", " ") for name in change.index])
        axes.tick_params(length=0, labelsize="small")
        axes.set_title(title.replace(" - ", " minus "), fontsize="medium")
        for row, column in np.argwhere(np.abs(numbers) >= 0.005):
            value = numbers[row, column]
            colour = "white" if abs(value) > 0.6 * LARGEST else "black"
            style: dict[str, Any] = {"ha": "center", "va": "center", "color": colour, "fontsize": 8}
            axes.text(column, row, f"{100 * value:+.0f}", **style)
    label = "change of the share of sessions (numbers: percentage points)"
    ticks = np.linspace(-LARGEST, LARGEST, 5)
    bar = figure.colorbar(image, ax=panels, label=label, shrink=0.6, ticks=ticks)
    bar.ax.set_yticklabels([f"{100 * tick:+.0f}" for tick in ticks])
    return figure
