"""Figures of training: results of each fold and seed, and the losses."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.predictors.scoring import SHORT
from grasptypes.predictors.variants import VARIANTS
from grasptypes.reports.figures import (
    CONSTANT,
    LABELLED,
    MEASURES,
    OURS,
    PAPER,
    add_legend,
    known_models,
    label_sources,
    name_models,
    rows_of_panels,
)
from grasptypes.reports.results import paper_figures

# Width over which the seeds of a model are spread, in axis units.
SPREAD = 0.5


def draw_folds(metrics: pd.DataFrame) -> Figure:
    """A dot per fold and seed, their mean, and the paper's figure, for each model and measure.

    Args:
        metrics: of `results.METRIC_SCHEMA`; one row of panels per label source.
    """
    sources = label_sources(metrics)
    figure = Figure(figsize=(13, 0.6 + 3.2 * len(sources)), layout="constrained")
    panels = rows_of_panels(sources, len(SHORT), figure, sharey="row")
    for labels, row in panels.items():
        for axes, measure in zip(row, SHORT, strict=True):
            _dots(axes, metrics[metrics["labels"] == labels], measure)
            axes.set_title(MEASURES[SHORT[measure]], fontsize="medium")
        row[0].set_ylabel(f"{labels} labels")
    add_legend(figure, loc="outside lower center", ncols=3)
    return figure


def draw_losses(curves: dict[tuple[str, str], pd.DataFrame]) -> Figure:
    """Mean training and test loss per epoch, and the range over folds and seeds.

    Args:
        curves: tables of `results.CURVE_SCHEMA` by labels and model; one row of panels per source.
    """
    sources = list(dict.fromkeys(labels for labels, _ in curves))
    models = [model for model in VARIANTS if (sources[0], model) in curves]
    figure = Figure(figsize=(10, 0.6 + 2.6 * len(sources)), layout="constrained")
    panels = rows_of_panels(sources, len(models), figure, sharex=True, sharey=True)
    for labels, row in panels.items():
        for axes, model in zip(row, models, strict=True):
            for name, colour in (("train_loss", OURS), ("test_loss", CONSTANT)):
                _curve(axes, curves[labels, model], name, colour)
            axes.set_title(LABELLED[model], fontsize="medium")
            axes.grid(alpha=0.3)
        row[0].set_ylabel(f"loss, {labels} labels")
    for axes in panels[sources[-1]]:
        axes.set_xlabel("epoch")
    add_legend(figure, loc="outside lower center", ncols=2)
    return figure


def _dots(axes: Axes, rows: pd.DataFrame, measure: str) -> None:
    models = known_models(set(rows["model"]))
    seeds = sorted(set(rows["seed"]))
    place = rows["model"].map(models.index)
    beside = (rows["seed"].map(seeds.index) - (len(seeds) - 1) / 2) * SPREAD / len(seeds)
    name = "one fold and seed"
    axes.scatter(
        place + beside, rows[measure], s=14, color=OURS, alpha=0.6, linewidths=0, label=name
    )
    means = [rows[rows["model"] == model][measure].mean() for model in models]
    column = f"paper_{SHORT[measure]}"
    papers = [paper_figures(model).get(column, np.nan) for model in models]
    left = np.arange(len(models)) - 0.38
    for heights, colour, name in ((means, "black", "mean"), (papers, PAPER, "paper")):
        axes.hlines(heights, left, left + 0.76, colors=colour, label=name)
    name_models(axes, models)
    axes.tick_params(axis="x", labelsize="small")
    axes.grid(axis="y", alpha=0.3)


def _curve(axes: Axes, curves: pd.DataFrame, name: str, colour: str) -> None:
    epochs = curves.dropna(subset=[name]).groupby("epoch")[name]
    if epochs.ngroups == 0:
        return
    mean, low, high = epochs.mean(), epochs.min(), epochs.max()
    axes.plot(mean.index, mean, color=colour, label=name.replace("_loss", ""))
    axes.fill_between(np.asarray(mean.index), low, high, color=colour, alpha=0.2, linewidth=0)
