"""Which regions of an image spoke for each grasp type: what changes when they are hidden.

Squares of the image are blurred, one at a time, and the prediction is asked again (Zeiler and
Fergus 2014). It needs nothing of the network but its answers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure
from PIL import Image
from scipy import ndimage

from grasptypes.settings.commands import ExplanationSettings

# Images (N, S, S, 3) to logits (N, types).
Ask = Callable[[Sequence[np.ndarray]], np.ndarray]


def small(picture: np.ndarray, size_px: int) -> np.ndarray:
    """An image (S, S, 3) of the backbone's size, in which squares are hidden."""
    whole = Image.fromarray(picture).resize((size_px, size_px), Image.Resampling.BILINEAR)
    return np.asarray(whole)


def blurred(picture: np.ndarray, settings: ExplanationSettings) -> np.ndarray:
    """The image without anything that could be recognised."""
    deviation = settings.blur * len(picture)
    soft = ndimage.gaussian_filter(picture.astype(np.float32), (deviation, deviation, 0))
    return np.asarray(soft.round().astype(np.uint8))


def explain(picture: np.ndarray, ask: Ask, settings: ExplanationSettings) -> np.ndarray:
    """By how much hiding each pixel's surroundings lowers the logits: (types, S, S).

    Args:
        picture: (S, S, 3) uint8.
        ask: the predictor, for one task.
    """
    size = len(picture)
    side = max(round(settings.window * size), 1)
    starts = np.linspace(0, size - side, settings.steps).round().astype(int)
    soft = blurred(picture, settings)
    hidden, places = [picture], []
    for top in starts:
        for left in starts:
            changed = picture.copy()
            place = slice(top, top + side), slice(left, left + side)
            changed[place] = soft[place]
            hidden.append(changed)
            places.append(place)
    logits = ask(hidden)
    falls = logits[0] - logits[1:]
    heat = np.zeros((falls.shape[1], size, size))
    covered = np.zeros((size, size))
    for fall, place in zip(falls, places, strict=True):
        heat[(slice(None), *place)] += fall[:, None, None]
        covered[place] += 1
    return heat / np.maximum(covered, 1)


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
