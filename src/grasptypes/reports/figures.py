"""Figures of the learning results; the same table gives the same bytes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage

from grasptypes.labels.samples import TYPES
from grasptypes.predictors.predictor import VARIANTS
from grasptypes.predictors.scoring import SHORT
from grasptypes.reports.breakdown import KNOWN, UNSEEN
from grasptypes.reports.results import PAPER_COLUMNS, constant_rows, paper_figures

LABELLED = {
    "no_task": "(a) no task",
    "task_vector": "(b) task vector",
    "task_in_image": "(c) task in image",
    "ignores_task": "(d) ignores task",
    "e_mobilenet_v2": "(e) frequencies",
}
MEASURES = {
    "sim": "angular similarity",
    "acc": "multilabel accuracy",
    "prec": "precision",
    "freq": "similarity to frequencies",
}
CONSTANT_LABEL = "constant answer fitted to the other objects"
OURS, PAPER, CEILING, CONSTANT = "#2a6f97", "#c9a227", "#6c757d", "#b23a48"
FIFTH = "#4f772d"  # for one more line
# End of the axes, and the share of their height for the numbers at the base of the bars.
TOP, FOOT = 1.02, 0.2
# Width over which the seeds of a model are spread, in axis units.
SPREAD = 0.5


def draw_table(table: pd.DataFrame) -> Figure:
    """Bars of mean and spread for each model and measure, with the paper's figures and the ceiling.

    If the table has no figures from the paper, the constant answer of the others is drawn instead.

    Args:
        table: of `results.RESULT_SCHEMA`; one row of panels per label source.
    """
    used = table[table["n_folds"] > 0]
    sources = _sources(used)
    figure = Figure(figsize=(13, 3.2 * len(sources)))
    panels = _rows_of_panels(sources, len(MEASURES), figure, sharey=True)
    for labels, row in panels.items():
        for axes, (short, title) in zip(row, MEASURES.items(), strict=True):
            _bars(axes, used[used["labels"] == labels], short)
            if not _has_paper(used):
                constant = constant_rows(table, labels)[f"{short}_mean"]
                _steps(axes, constant, CONSTANT, CONSTANT_LABEL)
            axes.set_title(title, fontsize=10)
        row[0].set_ylabel(f"{labels} labels")
    figure.axes[0].set_ylim(_bottom(used), TOP)
    _legend(figure, loc="lower center", ncols=3, fontsize=9)
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
    _name_models(axes, list(rows["model"]), fontsize=8)
    axes.grid(axis="y", alpha=0.3)
    axes.set_axisbelow(True)


def draw_folds(metrics: pd.DataFrame) -> Figure:
    """A dot per fold and seed, their mean, and the paper's figure, for each model and measure.

    Args:
        metrics: of `results.METRIC_SCHEMA`; one row of panels per label source.
    """
    sources = _sources(metrics)
    figure = Figure(figsize=(13, 0.6 + 3.2 * len(sources)), layout="constrained")
    panels = _rows_of_panels(sources, len(SHORT), figure, sharey="row")
    for labels, row in panels.items():
        for axes, measure in zip(row, SHORT, strict=True):
            _dots(axes, metrics[metrics["labels"] == labels], measure)
            axes.set_title(MEASURES[SHORT[measure]], fontsize="medium")
        row[0].set_ylabel(f"{labels} labels")
    _legend(figure, loc="outside lower center", ncols=3)
    return figure


def draw_losses(curves: dict[tuple[str, str], pd.DataFrame]) -> Figure:
    """Mean training and test loss per epoch, and the range over folds and seeds.

    Args:
        curves: tables of `results.CURVE_SCHEMA` by labels and model; one row of panels per source.
    """
    sources = list(dict.fromkeys(labels for labels, _ in curves))
    models = [model for model in VARIANTS if (sources[0], model) in curves]
    figure = Figure(figsize=(10, 0.6 + 2.6 * len(sources)), layout="constrained")
    panels = _rows_of_panels(sources, len(models), figure, sharex=True, sharey=True)
    for labels, row in panels.items():
        for axes, model in zip(row, models, strict=True):
            for name, colour in (("train_loss", OURS), ("test_loss", CONSTANT)):
                _curve(axes, curves[labels, model], name, colour)
            axes.set_title(LABELLED[model], fontsize="medium")
            axes.grid(alpha=0.3)
        row[0].set_ylabel(f"loss, {labels} labels")
    for axes in panels[sources[-1]]:
        axes.set_xlabel("epoch")
    _legend(figure, loc="outside lower center", ncols=2)
    return figure


def _dots(axes: Axes, rows: pd.DataFrame, measure: str) -> None:
    models = _models(set(rows["model"]))
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
    _name_models(axes, models)
    axes.tick_params(axis="x", labelsize="small")
    axes.grid(axis="y", alpha=0.3)


def _curve(axes: Axes, curves: pd.DataFrame, name: str, colour: str) -> None:
    epochs = curves.dropna(subset=[name]).groupby("epoch")[name]
    if epochs.ngroups == 0:
        return
    mean, low, high = epochs.mean(), epochs.min(), epochs.max()
    axes.plot(mean.index, mean, color=colour, label=name.replace("_loss", ""))
    axes.fill_between(np.asarray(mean.index), low, high, color=colour, alpha=0.2, linewidth=0)


def draw_types(table: pd.DataFrame) -> Figure:
    """Recall, precision and accuracy of each grasp type and model; one row per label source.

    Args:
        table: of `breakdown.TYPE_SCHEMA`.
    """
    sources, measures = _sources(table), ("recall", "precision", "accuracy")
    figure = Figure(figsize=(11, 0.6 + 3.4 * len(sources)), layout="constrained")
    panels = _rows_of_panels(sources, len(measures), figure, sharey=True)
    for labels, row in panels.items():
        for axes, measure in zip(row, measures, strict=True):
            rows = table[table["labels"] == labels]
            values = rows.pivot(index="grasp_type", columns="model", values=measure)
            image = _heat_map(axes, values.loc[list(TYPES), _models(values.columns)])
            axes.set_title(f"{measure}, {labels} labels", fontsize="medium")
    figure.colorbar(image, ax=figure.axes, shrink=0.6, pad=0.01)
    return figure


def draw_objects(table: pd.DataFrame) -> Figure:
    """Similarity of each object and model, known and unseen; two panels per label source.

    Args:
        table: of `breakdown.OBJECT_SCHEMA`.
    """
    sources = _sources(table)
    names = sorted(set(table["object"]))
    figure = Figure(figsize=(2 + 5 * len(sources), 2.2 + 0.3 * len(names)), layout="constrained")
    panels = figure.subplots(1, 2 * len(sources), squeeze=False, sharey=True)[0]
    wanted = [(labels, objects) for labels in sources for objects in (KNOWN, UNSEEN)]
    for axes, (labels, objects) in zip(panels, wanted, strict=True):
        rows = table[(table["labels"] == labels) & (table["objects"] == objects)]
        values = rows.pivot(index="object", columns="model", values="angular_similarity")
        values = values.loc[names, _models(values.columns)]
        mean = values.mean().to_frame("mean").T
        image = _heat_map(axes, pd.concat([values, mean]))
        axes.axhline(len(names) - 0.5, color="white", linewidth=3)
        axes.set_title(f"{objects} objects,\n{labels} labels", fontsize="medium")
    figure.colorbar(image, ax=panels, label="angular similarity", shrink=0.6, pad=0.01)
    return figure


def _heat_map(axes: Axes, values: pd.DataFrame) -> AxesImage:
    """Shares from 0 to 1 as colours and numbers; columns are models."""
    numbers = values.to_numpy(dtype=float)
    image = axes.imshow(numbers, cmap="viridis", vmin=0, vmax=1, aspect="auto")
    axes.set_yticks(range(len(values)), [str(name).replace("_", " ") for name in values.index])
    _name_models(axes, list(values.columns))
    axes.tick_params(length=0, labelsize="small")
    for row, column in np.argwhere(np.isfinite(numbers)):
        value = numbers[row, column]
        colour = "black" if value > 0.6 else "white"
        axes.text(column, row, f"{value:.2f}", ha="center", va="center", color=colour, fontsize=7.5)
    return image


def draw_generalisation(table: pd.DataFrame) -> Figure:
    """One panel per label source; solid lines: images per object equal, dashed lines: views equal.

    Args:
        table: of `generalisation.GENERALISATION_SCHEMA`.
    """
    sources = _sources(table)
    figure = Figure(figsize=(5 * len(sources), 4.2))
    panels = figure.subplots(1, len(sources), sharey=True, squeeze=False)[0]
    for axes, labels in zip(panels, sources, strict=True):
        _lines(axes, table[table["labels"] == labels])
        axes.set_title(f"{labels} labels", fontsize=10)
        axes.set_xlabel("shapes of every object trained on")
    panels[0].set_ylabel("angular similarity on objects left out")
    _legend(figure, loc="lower center", ncols=3, fontsize=8)
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
    for model in _models(set(rows["model"])):
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


def _sources(table: pd.DataFrame) -> list[str]:
    """The label sources of a table, in order."""
    return list(dict.fromkeys(table["labels"]))


def _rows_of_panels(
    sources: Sequence[str], columns: int, figure: Figure, **shared: Any
) -> dict[str, list[Axes]]:
    """A row of panels for each label source."""
    panels = figure.subplots(len(sources), columns, squeeze=False, **shared)
    return dict(zip(sources, map(list, panels), strict=True))


def _models(known: Collection[str]) -> list[str]:
    """The known models, in the order of Table I."""
    return [model for model in VARIANTS if model in known]


def _name_models(axes: Axes, models: Sequence[str], **style: Any) -> None:
    """Write the models' names below positions 0, 1, ..."""
    names = [LABELLED[model] for model in models]
    axes.set_xticks(range(len(names)), names, rotation=25, ha="right", **style)


def _legend(figure: Figure, **style: Any) -> None:
    """One legend for all panels, with the entries of the first one."""
    handles, names = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, names, frameon=False, **style)
