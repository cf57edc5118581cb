"""Which regions of an image spoke for each grasp type: what changes when they are hidden.

Squares of the image are blurred, one at a time, and the prediction is asked again (Zeiler and
Fergus 2014). It needs nothing of the network but its answers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
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
