"""The figure of similarity by the number of tasks, and with tasks that were not learnt from."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.predictors.many_task_tables import DIFFERING, EVERYTHING, REFERENCES
from grasptypes.predictors.told import MODELS
from grasptypes.reports.figures import CEILING, CONSTANT, OURS, PAPER, add_legend

COLOURS = {
    "no_task": "black",
    "task_vector": OURS,
    "task_in_image": PAPER,
    "film": "#7b2d8b",
    "affordance_vector": "#4f772d",
    "film_affordance": "#e07a5f",
    "demonstration": "#00a6a6",
    "constant": CONSTANT,
    "object_known": CEILING,
}
# Horizontal distance of models with the same number of tasks, as a share of that number.
APART = 0.015


def draw_many_tasks(table: pd.DataFrame) -> Figure:
    """All pairs, those of objects whose labels differ between tasks, and tasks left out.

    Args:
        table: of `many_task_tables.TABLE_SCHEMA`.
    """
    figure = Figure(figsize=(13, 5), layout="constrained")
    panels = figure.subplots(1, 3, width_ratios=(1, 1, 1.5))
    known = table[table["split"] == "views"]
    for axes, evaluated, title in (
        (panels[0], EVERYTHING, "all pairs of objects and tasks"),
        (panels[1], DIFFERING, "objects whose labels differ"),
    ):
        _lines(axes, known[known["evaluated"] == evaluated])
        axes.set_title(title, fontsize="medium")
    panels[0].set_ylabel("angular similarity")
    _left_out(panels[2], table[table["split"] == "tasks"])
    add_legend(figure, loc="outside lower center", ncols=5)
    return figure


def _lines(axes: Axes, rows: pd.DataFrame) -> None:
    numbers = sorted(set(rows["tasks"]))
    for place, name in enumerate(MODELS):
        own = rows[rows["model"] == name].sort_values("tasks")
        beside = own["tasks"] * (1 + APART * (place - len(MODELS) // 2))
        axes.errorbar(
            beside,
            own["sim_mean"],
            own["sim_se"],
            marker="o",
            markersize=4,
            color=COLOURS[name],
            label=MODELS[name],
            capsize=2,
        )
    for name, meaning in REFERENCES.items():
        own = rows[rows["model"] == name].sort_values("tasks")
        axes.plot(own["tasks"], own["sim_mean"], ":", color=COLOURS[name], label=meaning)
    axes.set_xscale("log")
    axes.set_xticks(numbers, [str(number) for number in numbers])
    axes.minorticks_off()
    axes.set_xlabel("number of tasks")
    axes.grid(alpha=0.3)


def _left_out(axes: Axes, rows: pd.DataFrame) -> None:
    columns = list(dict.fromkeys(rows["evaluated"]))
    columns = [EVERYTHING, *(name for name in columns if name != EVERYTHING)]
    models = [name for name in (*MODELS, *REFERENCES) if name in set(rows["model"])]
    for place, name in enumerate(models):
        own = rows[rows["model"] == name].set_index("evaluated").loc[columns]
        beside = [number + 0.1 * (place - (len(models) - 1) / 2) for number in range(len(columns))]
        label = {**MODELS, **REFERENCES}[name]
        marker = "_" if name in REFERENCES else "o"
        axes.errorbar(
            beside,
            own["sim_mean"],
            own["sim_se"],
            fmt=marker,
            markersize=8 if name in REFERENCES else 4,
            color=COLOURS[name],
            label=label,
            capsize=2,
        )
    pairs = rows.drop_duplicates("evaluated").set_index("evaluated")["n_pairs"]
    names = ["all tasks" if name == EVERYTHING else name for name in columns]
    ticks = [f"{name}\n({pairs[column]})" for name, column in zip(names, columns, strict=True)]
    axes.set_xticks(range(len(columns)), ticks)
    axes.axvline(0.5, color="black", linewidth=0.6)
    axes.set_title("a task that was not learnt from (number of objects)", fontsize="medium")
    axes.grid(axis="y", alpha=0.3)
