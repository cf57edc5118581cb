"""Figures of the training: every fold and seed beside the mean and the paper, and the losses."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.predictors.predictor import VARIANTS
from grasptypes.predictors.scoring import SHORT
from grasptypes.reports.result_plots import LABELLED, MEASURES, OURS, PAPER
from grasptypes.reports.results import PAPER as PAPER_ROWS

TEST, TRAIN = "#b23a48", OURS
# Width over which the seeds of a model lie beside each other, in places on the axis.
SPREAD = 0.5


def draw_folds(metrics: pd.DataFrame) -> Figure:
    """A dot a fold and seed, their mean, and the paper's figure, for each model and measure.

    Args:
        metrics: of `results.METRIC_SCHEMA`; one row of panels a label source.
    """
    sources = list(dict.fromkeys(metrics["labels"]))
    figure = Figure(figsize=(10, 0.6 + 3.2 * len(sources)), layout="constrained")
    panels = figure.subplots(len(sources), len(SHORT), squeeze=False, sharey="row")
    for row, labels in zip(panels, sources, strict=True):
        for column, (axes, measure) in enumerate(zip(row, SHORT, strict=True)):
            _dots(axes, metrics[metrics["labels"] == labels], measure, column)
            axes.set_title(MEASURES[SHORT[measure]], fontsize="medium")
        row[0].set_ylabel(f"{labels} labels")
    handles, names = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=3, frameon=False)
    return figure


def draw_losses(curves: dict[tuple[str, str], pd.DataFrame]) -> Figure:
    """Mean loss of training and test an epoch, and the range over folds and seeds.

    Args:
        curves: tables of `results.CURVE_SCHEMA` by labels and model; one row of panels a source.
    """
    sources = list(dict.fromkeys(labels for labels, _ in curves))
    models = [model for model in VARIANTS if (sources[0], model) in curves]
    figure = Figure(figsize=(10, 0.6 + 2.6 * len(sources)), layout="constrained")
    panels = figure.subplots(len(sources), len(models), squeeze=False, sharex=True, sharey=True)
    for row, labels in zip(panels, sources, strict=True):
        for axes, model in zip(row, models, strict=True):
            for name, colour in (("train_loss", TRAIN), ("test_loss", TEST)):
                _curve(axes, curves[labels, model], name, colour)
            axes.set_title(f"{LABELLED[model]}", fontsize="medium")
            axes.grid(alpha=0.3)
        row[0].set_ylabel(f"loss, {labels} labels")
    for axes in panels[-1]:
        axes.set_xlabel("epoch")
    handles, names = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=2, frameon=False)
    return figure


def _dots(axes: Axes, rows: pd.DataFrame, measure: str, column: int) -> None:
    models = [model for model in VARIANTS if model in set(rows["model"])]
    seeds = sorted(set(rows["seed"]))
    place = rows["model"].map(models.index)
    beside = (rows["seed"].map(seeds.index) - (len(seeds) - 1) / 2) * SPREAD / len(seeds)
    name = "one fold and seed"
    axes.scatter(
        place + beside, rows[measure], s=14, color=OURS, alpha=0.6, linewidths=0, label=name
    )
    means = [rows[rows["model"] == model][measure].mean() for model in models]
    papers = [PAPER_ROWS[model][column] for model in models]
    left = np.arange(len(models)) - 0.38
    for heights, colour, name in ((means, "black", "mean"), (papers, PAPER, "paper")):
        axes.hlines(heights, left, left + 0.76, colors=colour, label=name)
    axes.set_xticks(range(len(models)), [LABELLED[m] for m in models], rotation=25, ha="right")
    axes.tick_params(axis="x", labelsize="small")
    axes.grid(axis="y", alpha=0.3)


def _curve(axes: Axes, curves: pd.DataFrame, name: str, colour: str) -> None:
    epochs = curves.dropna(subset=[name]).groupby("epoch")[name]
    if epochs.ngroups == 0:
        return
    mean, low, high = epochs.mean(), epochs.min(), epochs.max()
    axes.plot(mean.index, mean, color=colour, label=name.replace("_loss", ""))
    axes.fill_between(np.asarray(mean.index), low, high, color=colour, alpha=0.2, linewidth=0)
