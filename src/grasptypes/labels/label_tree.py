"""Figure of the decision tree of grasp types, with the number of grasps in each leaf."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from grasptypes.labels.dataset import VALID
from grasptypes.labels.grasp_type import TREE, Branch, amount, leaves, virtual_fingers
from grasptypes.settings.grasp_types import Thresholds

Picture = NDArray[np.uint8]

# Layout in units of leaf spacing and question spacing: half the height of a question's box, top of
# the leaves, and half the width of the text at a branch.
HALF, LEAF_TOP, WORDS = 0.19, -3.85, 0.28


def typical_grasps(dataset: pd.DataFrame) -> dict[str, pd.Series]:
    """For each grasp type that occurs, the valid grasp farthest from all thresholds on its path.

    Args:
        dataset: of `dataset.DATASET_SCHEMA`.
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
    axes.set_xlim(-0.55, len(leaves()) - 0.45)
    axes.set_ylim(-5.75, 0.3)
    places = {name: float(place) for place, name in enumerate(leaves())}
    _draw(axes, TREE, 0.0, places, counts, thresholds)
    for name, place in places.items():
        _leaf(axes, name, place, counts)
        if name in pictures:
            inset = axes.inset_axes((place - 0.47, -5.7, 0.94, 1.25), transform=axes.transData)
            inset.imshow(pictures[name])
            inset.set_axis_off()
    total = sum(counts.values())
    title = f"{total + rejected} grasps: {total} valid, {rejected} rejected by physics (Invalid)"
    axes.set_title(title, fontsize="medium")
    return figure


def _draw(
    axes: Axes,
    branch: Branch,
    depth: float,
    places: Mapping[str, float],
    counts: Mapping[str, int],
    thresholds: Thresholds,
) -> float:
    """Draw a branch and everything below it; returns its horizontal position."""
    place, bottom = float(np.mean([places[name] for name in leaves(branch)])), -depth - HALF
    limit = amount(branch.measure, getattr(thresholds, branch.threshold))
    for child, words in ((branch.below, f"≤ {limit}"), (branch.above, f"> {limit}")):
        if isinstance(child, str):
            end = places[child], LEAF_TOP
        else:
            end = _draw(axes, child, depth + 1, places, counts, thresholds), -depth - 1 + HALF
        axes.plot([place, end[0]], [bottom, end[1]], color="#9a9a9a", zorder=0)
        # Low enough that the texts of the two branches are side by side.
        down = max(0.3, WORDS / max(abs(end[0] - place), WORDS))
        at = place + down * (end[0] - place), bottom + down * (end[1] - bottom)
        axes.text(*at, words, ha="center", va="center", fontsize="small", bbox=_BARE)
    number = sum(counts.get(name, 0) for name in leaves(branch))
    text = f"{branch.name}\n{number} grasps"
    axes.text(place, -depth, text, ha="center", va="center", fontsize="small", bbox=_BOX)
    return place


_BOX = {"boxstyle": "round", "facecolor": "#eef2f5", "edgecolor": "#5f6b73"}
_BARE = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}


def _leaf(axes: Axes, name: str, place: float, counts: Mapping[str, int]) -> None:
    text = f"{name}\n{counts.get(name, 0)} grasps\n{virtual_fingers(name)} virtual fingers"
    axes.text(place, -4.12, text, ha="center", va="center", fontsize="small", bbox=_BOX)
