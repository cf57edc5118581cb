"""Figures of predictions: the images that the predictor saw, next to bars of its answers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.predictors.prediction import Answer, Card, spelled

CHOSEN, OTHER = "#2a6f97", "#b8c4cc"
ROW_IN = 2.6
NAME_LENGTH = 40  # letters that fit above an image
LABEL_ROOM = 1.18  # right end of the bars' axis, with room for the number of a bar of 1


def draw_answers(
    pictures: Sequence[np.ndarray], answers: Sequence[Answer], card: Card, task: str
) -> Figure:
    """One row per answer: its image (H, W, 3) uint8 on the left, its bars on the right."""
    asked = f"for {task}" if card.sees_task else "whatever the task"
    title = f"{card.model}, {card.labels} labels, {asked}; {card.backbone}, {card.weights}"
    height_in = ROW_IN * len(answers) + 0.5
    figure = Figure(figsize=(8.0, height_in), layout="constrained")
    panels = figure.subplots(len(answers), 2, squeeze=False, width_ratios=(1, 1.6))
    for (shown, bars), picture, answer in zip(panels, pictures, answers, strict=True):
        shown.imshow(picture)
        shown.set_axis_off()
        shown.set_title(_shortened(answer.name), fontsize="small", parse_math=False)
        _draw_bars(bars, answer)
    panels[-1][1].set_xlabel("probability; chosen types are dark", fontsize="small")
    figure.suptitle(title, fontsize="small", parse_math=False)
    return figure


def montage(views: np.ndarray) -> np.ndarray:
    """Views (N, H, W, 3) in rows of nearly equal length."""
    columns = int(np.ceil(np.sqrt(len(views))))
    empty = np.full((-len(views) % columns, *views.shape[1:]), 255, dtype=np.uint8)
    tiles = np.concatenate([views, empty])
    rows = [np.hstack(list(tiles[k : k + columns])) for k in range(0, len(tiles), columns)]
    return np.vstack(rows)


def _shortened(name: str) -> str:
    """A name, with its middle removed if it is long."""
    half = NAME_LENGTH // 2
    return name if len(name) <= NAME_LENGTH else f"{name[:half]}…{name[1 - half :]}"


def _draw_bars(axes: Axes, answer: Answer) -> None:
    colours = [CHOSEN if yes else OTHER for yes in answer.chosen]
    kinds = [spelled(kind) for kind in answer.types]
    bars = axes.barh(kinds, answer.probability, color=colours)
    axes.bar_label(bars, [f"{value:.2f}" for value in answer.probability], padding=3, fontsize=8)
    axes.invert_yaxis()
    axes.set_xlim(0, LABEL_ROOM)
    axes.set_xticks(np.linspace(0, 1, 6))
    axes.tick_params(labelsize="small")
    axes.spines[["top", "right"]].set_visible(False)
