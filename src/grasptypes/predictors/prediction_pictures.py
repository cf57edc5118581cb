"""Figures of predictions: the images that the predictor saw, next to bars of its answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grasptypes.predictors.answers import Answer, Card
from grasptypes.predictors.explanation import small
from grasptypes.predictors.general_predictor import TRAINED
from grasptypes.predictors.known_kinds import LOOKS, read_looks

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
    figure = Figure(figsize=(9.0, height_in), layout="constrained")
    panels = figure.subplots(len(answers), 3, squeeze=False, width_ratios=(1, 1.6, 0.5))
    for (shown, bars, alike), picture, answer in zip(panels, pictures, answers, strict=True):
        shown.imshow(picture)
        shown.set_axis_off()
        shown.set_title(_shortened(answer.name), fontsize="small", parse_math=False)
        _draw_bars(bars, answer)
        _draw_alike(alike, answer)
    panels[-1][1].set_xlabel("probability that it occurs; chosen types are dark", fontsize="small")
    figure.suptitle(title, fontsize="small", parse_math=False)
    return figure


def montage(pictures: Sequence[np.ndarray], size_px: int) -> np.ndarray:
    """Square images (S, S, 3) in rows of nearly equal length, `size_px` wide each."""
    views = np.stack([small(picture, size_px) for picture in pictures])
    columns = int(np.ceil(np.sqrt(len(views))))
    empty = np.full((-len(views) % columns, *views.shape[1:]), 255, dtype=np.uint8)
    tiles = np.concatenate([views, empty])
    rows = [np.hstack(list(tiles[k : k + columns])) for k in range(0, len(tiles), columns)]
    return np.vstack(rows)


def _shortened(name: str) -> str:
    """A name, with its middle removed if it is long."""
    half = NAME_LENGTH // 2
    return name if len(name) <= NAME_LENGTH else f"{name[:half]}…{name[1 - half :]}"


def _draw_alike(axes: Axes, answer: Answer) -> None:
    """The most similar known kinds, one above the other, with their names."""
    axes.set_axis_off()
    if not answer.neighbours:
        return
    looks = read_looks([one.name for one in answer.neighbours], TRAINED / LOOKS)
    axes.imshow(np.vstack(looks))
    axes.set_title("looks like", fontsize="small")
    for number, (one, look) in enumerate(zip(answer.neighbours, looks, strict=True)):
        name = one.name.replace("_", " ")
        axes.text(0, number * len(look) + 4, name, fontsize=6, va="top")


def _draw_bars(axes: Axes, answer: Answer) -> None:
    kinds, values = list(answer.probabilities), list(answer.probabilities.values())
    colours = [CHOSEN if kind in answer.chosen else OTHER for kind in kinds]
    bars = axes.barh(kinds, values, color=colours)
    axes.bar_label(bars, [f"{value:.2f}" for value in values], padding=3, fontsize=8)
    axes.invert_yaxis()
    axes.set_xlim(0, LABEL_ROOM)
    axes.set_xticks(np.linspace(0, 1, 6))
    axes.tick_params(labelsize="small")
    axes.spines[["top", "right"]].set_visible(False)


def draw_explanation(picture: np.ndarray, heat: Mapping[str, np.ndarray], title: str) -> Figure:
    """The image, and over it what spoke for (red) and against (blue) each type.

    Args:
        heat: (S, S) of :func:`explain` by the name of each type.
    """
    figure = Figure(figsize=(2.2 * (len(heat) + 1), 2.7), layout="constrained")
    panels = figure.subplots(1, len(heat) + 1)
    most = max(float(np.abs(list(heat.values())).max()), 1e-9)
    panels[0].set_title("image", fontsize="small")
    for panel in panels:
        panel.imshow(picture)
        panel.set_axis_off()
    for panel, (name, layer) in zip(panels[1:], heat.items(), strict=True):
        shade = panel.imshow(layer, cmap="RdBu_r", vmin=-most, vmax=most, alpha=0.55)
        panel.set_title(name, fontsize="small")
    bar = figure.colorbar(shade, ax=list(panels), shrink=0.8)
    bar.set_label("fall of the logit when hidden", fontsize="small")
    figure.suptitle(title, fontsize="small", parse_math=False)
    return figure
