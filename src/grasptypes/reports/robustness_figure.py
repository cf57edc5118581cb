"""The chart of how robust the grasps are, by object and task."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.physics.engines import ENGINES
from grasptypes.robustness.tables import holds_six

COLOURS = ("#2a6f97", "#c9a227", "#6c757d", "#b23a48")


def draw_robustness(tests: pd.DataFrame) -> Figure:
    """Bars by object and task: mean robustness, and the share that holds in all directions.

    Args:
        tests: of `tables.ROBUSTNESS_SCHEMA`.
    """
    valid = tests[tests.valid]
    both = np.logical_and.reduce([holds_six(valid, name).to_numpy() for name in ENGINES])
    shown = valid.assign(six_both=both.astype(float))
    objects, tasks = sorted(set(tests.Object)), sorted(set(tests.Intent))
    figure = Figure(figsize=(9, 1.4 + 0.32 * len(objects)))
    left, right = figure.subplots(1, 2, sharey=True)
    titles = {
        "robustness": "held with other friction, mass and place\n(mean share of draws)",
        "six_both": "held in all directions in both engines\n(share of valid grasps)",
    }
    for axes, (column, title) in zip((left, right), titles.items(), strict=True):
        _bars(axes, shown.groupby(["Object", "Intent"])[column].mean(), objects, tasks)
        axes.set_title(title, fontsize=10)
        axes.axvline(shown[column].mean(), color="black", linewidth=0.8, linestyle="dashed")
    left.set_yticks(range(len(objects)), objects)
    left.set_ylim(len(objects) - 0.5, -0.5)
    figure.legend(
        *left.get_legend_handles_labels(), fontsize=9, loc="lower center", ncols=len(tasks)
    )
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    return figure


def _bars(axes: Axes, shares: pd.Series, objects: list[str], tasks: list[str]) -> None:
    height = 0.8 / len(tasks)
    for index, task in enumerate(tasks):
        widths = [shares.get((name, task), np.nan) for name in objects]
        places = np.arange(len(objects)) + (index - (len(tasks) - 1) / 2) * height
        axes.barh(places, widths, height, color=COLOURS[index % len(COLOURS)], label=task)
    axes.set_xlim(0.0, 1.0)
    axes.grid(axis="x", alpha=0.3)
    axes.set_axisbelow(True)
