"""Images for which a model names a wrong set of grasp types, worst answers first."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.special import softmax

from grasptypes.labels.samples import TYPES
from grasptypes.predictors.metrics import angular_similarity, chosen, shares
from grasptypes.renders.archives import read_pictures
from grasptypes.reports.breakdown import LOGITS, labels_for

MOST, COLUMNS = 20, 5
LETTERS = 42  # in a line of a caption
ASKED = ["object", "task", "view"]  # what an answer is about


def misclassified(predictions: pd.DataFrame, samples: pd.DataFrame) -> pd.DataFrame:
    """The worst wrong answer about every image and task that a fold or seed gets wrong.

    Args:
        predictions: of `scoring.PREDICTION_SCHEMA`.
        samples: of `samples.SAMPLE_SCHEMA`.

    Returns:
        columns object, task, view, similarity, predicted and labelled: sets of types in words. The
        worst image of every object and task comes first, then the second worst of each.
    """
    logits = predictions[list(LOGITS)].to_numpy(dtype=np.float64)
    labels, named = labels_for(predictions, samples), chosen(logits)
    wrong = (labels != named).any(axis=1)
    logits, labels, named = logits[wrong], labels[wrong], named[wrong]
    table = predictions.loc[wrong, ASKED].assign(
        similarity=angular_similarity(softmax(logits, axis=-1), shares(labels.astype(float))),
        predicted=[_in_words(row) for row in named],
        labelled=[_in_words(row) for row in labels],
    )
    table = table.sort_values(["similarity", *ASKED], ignore_index=True)
    table = table.drop_duplicates(ASKED, ignore_index=True)
    place = table.groupby(["object", "task"]).cumcount()
    return table.iloc[np.lexsort((table["similarity"], place))].reset_index(drop=True)


def draw_misclassified(
    name: str,
    predictions: pd.DataFrame,
    samples: pd.DataFrame,
    archives: Mapping[str, str | Path],
) -> Figure:
    """The first :data:`MOST` images that a model gets wrong, each with both sets of types.

    Args:
        name: of the model.
        predictions: of `scoring.PREDICTION_SCHEMA`.
        samples: of `samples.SAMPLE_SCHEMA`.
        archives: images of each object, see `archives.read_pictures`.
    """
    table = misclassified(predictions, samples)
    questions, seeds = len(predictions.drop_duplicates(ASKED)), predictions["seed"].nunique()
    what = "images and tasks" if predictions["task"].any() else "images"
    shown = table.head(MOST)
    rows = max(1, math.ceil(len(shown) / COLUMNS))
    figure = Figure(figsize=(2.4 * COLUMNS, 0.6 + 3.2 * rows), layout="constrained")
    wrong = f"{len(table)} of {questions} {what} get wrong types"
    figure.suptitle(f"{name}: {wrong} from at least one of {seeds} seeds")
    panels = list(figure.subplots(rows, COLUMNS, squeeze=False).flat)
    pictures = {name: read_pictures(archives[name]) for name in sorted(set(shown["object"]))}
    for axes in panels:
        axes.set_axis_off()
    for axes, row in zip(panels, shown.itertuples(), strict=False):
        axes.imshow(pictures[row.object][row.view])
        axes.set_title(_caption(row), fontsize=7, loc="left")
    return figure


def _caption(row: Any) -> str:
    about = f"{row.object}, {row.task}" if row.task else row.object
    lines = (
        f"{about}: similarity {row.similarity:.2f}",
        f"predicted: {row.predicted}",
        f"true: {row.labelled}",
    )
    return "\n".join(textwrap.fill(line, LETTERS) for line in lines)


def _in_words(types: NDArray[np.bool_]) -> str:
    names = [name.replace("_", " ") for name, there in zip(TYPES, types, strict=True) if there]
    return ", ".join(names) or "nothing"
