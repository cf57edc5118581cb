"""The figure of similarity on unseen objects against the number of shapes trained on."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.labels.label_pictures import save_figure
from grasptypes.reports.result_plots import CONSTANT_LABEL, LABELLED

COLOURS = ("#2a6f97", "#c9a227", "#6c757d", "#b23a48")


def plot_generalisation(table: pd.DataFrame, path: str | Path) -> None:
    """A panel a label source; full lines with pictures an object equal, dashed ones with views.

    Args:
        table: of `generalisation.GENERALISATION_SCHEMA`.
        path: of the PNG.
    """
    sources = list(dict.fromkeys(table["labels"]))
    figure = Figure(figsize=(5 * len(sources), 4.2))
    panels = figure.subplots(1, len(sources), sharey=True, squeeze=False)
    for axes, labels in zip(panels[0], sources, strict=True):
        _lines(axes, table[table["labels"] == labels])
        axes.set_title(f"{labels} labels", fontsize=10)
        axes.set_xlabel("shapes of every object trained on")
    panels[0][0].set_ylabel("angular similarity on objects left out")
    handles, names = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncols=3, frameon=False, fontsize=8)
    figure.tight_layout(rect=(0, 0.2, 1, 1))
    save_figure(figure, path)


def _lines(axes: Axes, rows: pd.DataFrame) -> None:
    pictures = rows["shapes"] * rows["views"]
    alone = rows["shapes"] == 1
    series = {
        f"{pictures[alone].max()} pictures an object": ("-", pictures == pictures[alone].max()),
        f"{rows['views'][alone].min()} pictures a shape": (
            "--",
            rows["views"] == rows["views"][alone].min(),
        ),
    }
    for colour, (model, title) in zip(COLOURS, LABELLED.items(), strict=True):
        if model not in set(rows["model"]):
            continue
        for kind, (style, chosen) in series.items():
            shown = rows[chosen & (rows["model"] == model)].sort_values("shapes")
            label = f"{title}, {kind}"
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
