"""The figure of similarity and accuracy by the number of training images of each object."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.reports.figures import (
    CEILING,
    LABELLED,
    MEASURES,
    OURS,
    PAPER,
    add_legend,
    known_models,
    label_sources,
    rows_of_panels,
)

SHOWN = ("sim", "acc")
COLOURS = {"no_task": CEILING, "task_vector": OURS, "task_in_image": PAPER}


def draw_learning_curve(table: pd.DataFrame, blind: dict[str, float]) -> Figure:
    """A row of panels for each label source, with standard errors.

    Args:
        table: of `learning_curve.CURVE_SCHEMA`.
        blind: by label source, the best similarity without the task.
    """
    sources = label_sources(table)
    figure = Figure(figsize=(9, 0.6 + 3.6 * len(sources)), layout="constrained")
    panels = rows_of_panels(sources, len(SHOWN), figure)
    for labels, row in panels.items():
        for axes, measure in zip(row, SHOWN, strict=True):
            _curves(axes, table[table["labels"] == labels], measure)
        row[0].axhline(blind[labels], color="black", ls=":", lw=1, label="best without the task")
        row[0].set_title(f"{labels} labels", fontsize="medium", loc="left")
    add_legend(figure, loc="outside lower center", ncols=4)
    return figure


def _curves(axes: Axes, rows: pd.DataFrame, measure: str) -> None:
    for model in known_models(set(rows["model"])):
        own = rows[rows["model"] == model].sort_values("views")
        axes.errorbar(
            own["views"],
            own[f"{measure}_mean"],
            own[f"{measure}_se"],
            marker="o",
            markersize=4,
            capsize=2,
            color=COLOURS.get(model, "black"),
            label=LABELLED[model],
        )
    axes.set_xscale("log")
    views = sorted(set(rows["views"]))
    axes.set_xticks(views, [str(number) for number in views])
    axes.minorticks_off()
    axes.set_xlabel("training images of each object")
    axes.set_ylabel(MEASURES[measure])
    axes.grid(alpha=0.3)
