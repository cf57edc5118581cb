"""Figures of the results of each grasp type and each object."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage

from grasptypes.labels.samples import TYPES
from grasptypes.reports.breakdown import KNOWN, UNSEEN
from grasptypes.reports.figures import (
    known_models,
    label_sources,
    name_models,
    rows_of_panels,
)


def draw_types(table: pd.DataFrame) -> Figure:
    """Recall, precision and accuracy of each grasp type and model; one row per label source.

    Args:
        table: of `breakdown.TYPE_SCHEMA`.
    """
    sources, measures = label_sources(table), ("recall", "precision", "accuracy")
    figure = Figure(figsize=(11, 0.6 + 3.4 * len(sources)), layout="constrained")
    panels = rows_of_panels(sources, len(measures), figure, sharey=True)
    for labels, row in panels.items():
        for axes, measure in zip(row, measures, strict=True):
            rows = table[table["labels"] == labels]
            values = rows.pivot(index="grasp_type", columns="model", values=measure)
            image = _heat_map(axes, values.loc[list(TYPES), known_models(values.columns)])
            axes.set_title(f"{measure}, {labels} labels", fontsize="medium")
    figure.colorbar(image, ax=figure.axes, shrink=0.6, pad=0.01)
    return figure


def draw_objects(table: pd.DataFrame) -> Figure:
    """Similarity of each object and model, known and unseen; two panels per label source.

    Args:
        table: of `breakdown.OBJECT_SCHEMA`.
    """
    sources = label_sources(table)
    names = sorted(set(table["object"]))
    figure = Figure(figsize=(2 + 5 * len(sources), 2.2 + 0.3 * len(names)), layout="constrained")
    panels = figure.subplots(1, 2 * len(sources), squeeze=False, sharey=True)[0]
    wanted = [(labels, objects) for labels in sources for objects in (KNOWN, UNSEEN)]
    for axes, (labels, objects) in zip(panels, wanted, strict=True):
        rows = table[(table["labels"] == labels) & (table["objects"] == objects)]
        values = rows.pivot(index="object", columns="model", values="angular_similarity")
        values = values.loc[names, known_models(values.columns)]
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
    name_models(axes, list(values.columns))
    axes.tick_params(length=0, labelsize="small")
    for row, column in np.argwhere(np.isfinite(numbers)):
        value = numbers[row, column]
        colour = "black" if value > 0.6 else "white"
        axes.text(column, row, f"{value:.2f}", ha="center", va="center", color=colour, fontsize=7.5)
    return image
