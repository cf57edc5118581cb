"""The figure of similarity on objects left out, by the number of shapes trained on."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.reports.figures import (
    CEILING,
    CONSTANT,
    CONSTANT_LABEL,
    LABELLED,
    OURS,
    PAPER,
    add_legend,
    known_models,
    label_sources,
)

FIFTH = "#4f772d"
"""Colour of one more line."""


def draw_generalisation(table: pd.DataFrame) -> Figure:
    """One panel per label source; solid lines: images per object equal, dashed lines: views equal.

    Args:
        table: of `generalisation.GENERALISATION_SCHEMA`.
    """
    sources = label_sources(table)
    figure = Figure(figsize=(5 * len(sources), 4.2))
    panels = figure.subplots(1, len(sources), sharey=True, squeeze=False)[0]
    for axes, labels in zip(panels, sources, strict=True):
        _lines(axes, table[table["labels"] == labels])
        axes.set_title(f"{labels} labels", fontsize=10)
        axes.set_xlabel("shapes of every object trained on")
    panels[0].set_ylabel("angular similarity on objects left out")
    add_legend(figure, loc="lower center", ncols=3, fontsize=8)
    figure.tight_layout(rect=(0, 0.2, 1, 1))
    return figure


def _lines(axes: Axes, rows: pd.DataFrame) -> None:
    pictures = rows["shapes"] * rows["views"]
    alone = rows["shapes"] == 1
    most, least = pictures[alone].max(), rows["views"][alone].min()
    series = {
        f"{most} pictures an object": ("-", pictures == most),
        f"{least} pictures a shape": ("--", rows["views"] == least),
    }
    colours = dict(zip(LABELLED, (OURS, PAPER, CEILING, CONSTANT, FIFTH), strict=True))
    for model in known_models(set(rows["model"])):
        colour = colours[model]
        for kind, (style, chosen) in series.items():
            shown = rows[chosen & (rows["model"] == model)].sort_values("shapes")
            label = f"{LABELLED[model]}, {kind}"
            axes.plot(
                shown["shapes"], shown["sim_mean"], style, marker="o", color=colour, label=label
            )
        constant = rows.loc[rows["model"] == model, "constant_sim"].iloc[0]
        axes.axhline(constant, color=colour, linewidth=0.8, linestyle=":")
    axes.plot([], [], color="black", linewidth=0.8, linestyle=":", label=CONSTANT_LABEL)
    axes.set_xscale("log")
    shapes = sorted(set(rows["shapes"]))
    axes.set_xticks(shapes, [str(number) for number in shapes])
    axes.minorticks_off()
    axes.grid(alpha=0.3)
