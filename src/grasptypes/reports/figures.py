"""What the figures of learning results share: names, colours, panels and legends.

The same table gives the same bytes.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.predictors.variants import VARIANTS

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


def label_sources(table: pd.DataFrame) -> list[str]:
    """The label sources of a table, in order."""
    return list(dict.fromkeys(table["labels"]))


def rows_of_panels(
    sources: Sequence[str], columns: int, figure: Figure, **shared: Any
) -> dict[str, list[Axes]]:
    """A row of panels for each label source."""
    panels = figure.subplots(len(sources), columns, squeeze=False, **shared)
    return dict(zip(sources, map(list, panels), strict=True))


def known_models(known: Collection[str]) -> list[str]:
    """The known models, in the order of Table I."""
    return [model for model in VARIANTS if model in known]


def name_models(axes: Axes, models: Sequence[str], **style: Any) -> None:
    """Write the models' names below positions 0, 1, ..."""
    names = [LABELLED[model] for model in models]
    axes.set_xticks(range(len(names)), names, rotation=25, ha="right", **style)


def add_legend(figure: Figure, **style: Any) -> None:
    """One legend for all panels, with the entries of the first one."""
    handles, names = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, names, frameon=False, **style)
