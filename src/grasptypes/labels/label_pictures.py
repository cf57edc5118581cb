"""Figures of the labels: the confusion matrix and the distribution of types."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from grasptypes.files import write_bytes
from grasptypes.labels.samples import COUNTS

DOTS_PER_INCH = 150


def draw_confusion(counts: NDArray[np.int64], types: tuple[str, ...], title: str) -> Figure:
    """A confusion matrix (k, k), rows are human labels; colour is the share within a row."""
    figure = Figure(figsize=(6.4, 5.6), layout="constrained")
    axes = figure.add_subplot()
    rows = counts.sum(axis=1, keepdims=True)
    share = counts / np.maximum(rows, 1)
    axes.imshow(share, cmap="Blues", vmin=0, vmax=1)
    names = [name.replace(" ", "\n") for name in types]
    axes.set_xticks(range(len(types)), names)
    axes.set_yticks(range(len(types)), names)
    axes.set_xlabel("by the rule")
    axes.set_ylabel("by people")
    for row, column in np.ndindex(*counts.shape):
        colour = "white" if share[row, column] > 0.5 else "black"
        axes.text(column, row, str(counts[row, column]), ha="center", va="center", color=colour)
    axes.set_title(title, fontsize="medium")
    return figure


def draw_distribution(table: pd.DataFrame, types: tuple[str, ...], title: str) -> Figure:
    """Our counts next to the published ones: per (object, task) and in total.

    Args:
        table: the rows of `distribution.DISTRIBUTION_SCHEMA` without the mean.
        types: names of the six types.
    """
    figure = Figure(figsize=(10.0, 9.0), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    names = [f"{row.object} {row.task}" for row in table.itertuples()]
    places = np.arange(len(table))
    for offset, prefix, weight in ((-0.2, "", 1.0), (0.2, "published_", 0.55)):
        counts = table[[f"{prefix}{name}" for name in COUNTS]].to_numpy(dtype=float)
        share = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
        start = np.cumsum(share, axis=1) - share
        for kind in range(len(types)):
            label = types[kind] if weight == 1.0 else None
            left.barh(
                places + offset,
                share[:, kind],
                0.38,
                start[:, kind],
                color=f"C{kind}",
                alpha=weight,
                label=label,
            )
    left.set_yticks(places, names, fontsize="x-small")
    left.set_ylim(len(table) - 0.4, -0.6)
    left.set_xlim(0, 1)
    left.set_xlabel("share of the grasps: ours above, published below (pale)")
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=6)
    _draw_totals(right, table, types)
    right.set_title(title.replace("; ", "\n"), fontsize="small")
    return figure


def _draw_totals(axes: Axes, table: pd.DataFrame, types: tuple[str, ...]) -> None:
    places = np.arange(len(types))
    ours = table[list(COUNTS)].sum().to_numpy()
    published = table[[f"published_{name}" for name in COUNTS]].sum().to_numpy()
    colours = [f"C{kind}" for kind in range(len(types))]
    bars = axes.bar(places - 0.2, ours, 0.38, color=colours)
    pale = axes.bar(places + 0.2, published, 0.38, color=colours, alpha=0.55)
    axes.bar_label(bars, fontsize="small")
    axes.bar_label(pale, fontsize="small")
    axes.set_xticks(places, [name.replace(" ", "\n") for name in types], fontsize="x-small")
    axes.set_ylabel("grasps: ours left, published right (pale)")


def save_figure(figure: Figure, path: str | Path) -> None:
    """Write a PNG without a date or library version."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=DOTS_PER_INCH, metadata={"Software": None})
    write_bytes(path, buffer.getvalue())
