"""Figure of the decision tree of grasp types, with the number of grasps in each leaf."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from grasptypes.labels.dataset import VALID
from grasptypes.labels.grasp_type import TREE, WAYS, Question, limits, virtual_fingers, ways
from grasptypes.settings.grasp_types import Thresholds

Picture = NDArray[np.uint8]

# Layout in units of leaf spacing and question spacing: half the height of a question's box, top of
# the leaves, and half the width of the text at a branch.
HALF, LEAF_TOP, WORDS = 0.19, -3.85, 0.28
BOX = {"boxstyle": "round", "facecolor": "#eef2f5", "edgecolor": "#5f6b73"}
BARE = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}


def typical_grasps(dataset: pd.DataFrame) -> dict[str, pd.Series]:
    """For each grasp type that occurs, the valid grasp farthest from all thresholds on its path.

    Args:
        dataset: of `dataset.dataset_schema`.
    """
    valid = dataset[dataset.reason == VALID]
    rows = valid.loc[valid.groupby("GraspType").margin.idxmax()]
    return {row.GraspType: row for _, row in rows.iterrows()}


def draw_label_tree(
    counts: Mapping[str, int],
    rejected: int,
    thresholds: Thresholds,
    pictures: Mapping[str, Picture],
) -> Figure:
    """The tree from top to bottom, with an image of a grasp below each leaf.

    Args:
        counts: valid grasps by type.
        rejected: number of grasps rejected by physics.
        pictures: images by type, for the types that occur.
    """
    figure = Figure(figsize=(10.5, 6.6), layout="constrained")
    axes = figure.add_subplot()
    axes.set_axis_off()
    axes.set_xlim(-0.55, len(WAYS) - 0.45)
    axes.set_ylim(-5.75, 0.3)
    places = {name: float(place) for place, name in enumerate(WAYS)}
    drawing = _Drawing(axes, places, counts, limits(thresholds).tolist())
    drawing.question(TREE, 0.0)
    for name, place in places.items():
        drawing.leaf(name)
        if name in pictures:
            inset = axes.inset_axes((place - 0.47, -5.7, 0.94, 1.25), transform=axes.transData)
            inset.imshow(pictures[name])
            inset.set_axis_off()
    total = sum(counts.values())
    title = f"{total + rejected} grasps: {total} valid, {rejected} rejected by physics (Invalid)"
    axes.set_title(title, fontsize="medium")
    return figure


@dataclass(frozen=True)
class _Drawing:
    """Where the leaves stand from left to right, their grasps, and the thresholds (4,)."""

    axes: Axes
    places: Mapping[str, float]
    counts: Mapping[str, int]
    thresholds: Sequence[float]

    def question(self, question: Question, depth: float) -> float:
        """Draw a question and all below it; returns its horizontal position."""
        names = ways(question)
        place, bottom = float(np.mean([self.places[name] for name in names])), -depth - HALF
        limit = question.amount(self.thresholds[question.measure])
        for child, words in ((question.below, f"≤ {limit}"), (question.above, f"> {limit}")):
            if isinstance(child, str):
                end = self.places[child], LEAF_TOP
            else:
                end = self.question(child, depth + 1), -depth - 1 + HALF
            self.axes.plot([place, end[0]], [bottom, end[1]], color="#9a9a9a", zorder=0)
            # Low enough that the texts of the two branches are side by side.
            down = max(0.3, WORDS / max(abs(end[0] - place), WORDS))
            self._write(
                place + down * (end[0] - place), bottom + down * (end[1] - bottom), words, BARE
            )
        number = sum(self.counts.get(name, 0) for name in names)
        self._write(place, -depth, f"{question.name}\n{number} grasps", BOX)
        return place

    def leaf(self, name: str) -> None:
        """Draw a type with its number of grasps."""
        fingers = f"{virtual_fingers(name)} virtual fingers"
        text = f"{name}\n{self.counts.get(name, 0)} grasps\n{fingers}"
        self._write(self.places[name], -4.12, text, BOX)

    def _write(self, x: float, y: float, text: str, box: dict[str, Any]) -> None:
        self.axes.text(x, y, text, ha="center", va="center", fontsize="small", bbox=box)
