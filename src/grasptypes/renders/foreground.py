"""How many objects an image shows, by a simple rule: connected regions unlike the image's border.

It knows nothing about objects. Where the border is not of about one colour it says nothing.
"""

from __future__ import annotations

import numpy as np
from PIL import Image
from scipy import ndimage

from grasptypes.renders.photos import Box
from grasptypes.settings.commands import ForegroundSettings

ASK = "name the part with --box or --mask"


def objects_in(picture: np.ndarray, settings: ForegroundSettings) -> list[Box] | None:
    """The boxes of all objects in an image (H, W, 3) uint8, the largest first; None: cannot say."""
    image = Image.fromarray(picture)
    image.thumbnail((settings.size_px, settings.size_px))
    small = np.asarray(image).astype(float)
    border = np.concatenate([small[0], small[-1], small[:, 0], small[:, -1]])
    colour = np.median(border, axis=0)
    spread = np.median(np.abs(border - colour).max(axis=1))
    differs = np.abs(small - colour).max(axis=2)
    limit = max(settings.contrast, settings.spreads * spread)
    unlike = ndimage.binary_closing(np.pad(differs > limit, 2), iterations=2)[2:-2, 2:-2]
    if unlike.mean() > settings.most or limit > 255 / 2:
        return None
    labels, _ = ndimage.label(unlike, np.ones((3, 3)))
    sizes = np.bincount(labels.ravel())[1:]
    least = max(settings.least * labels.size, settings.relative * max(sizes, default=0))
    scale = picture.shape[1] / small.shape[1]
    found = ndimage.find_objects(labels)
    return [_box(found[k], scale) for k in np.argsort(-sizes, kind="stable") if sizes[k] >= least]


def doubts(picture: np.ndarray, settings: ForegroundSettings) -> tuple[str, ...]:
    """What is to be said about an image (H, W, 3) of which no part was named."""
    boxes = objects_in(picture, settings)
    if boxes is None:
        return ()
    if not boxes:
        return (f"the image seems to show no object, only a background: {ASK}",)
    if len(boxes) == 1:
        return ()
    named = " or ".join(",".join(map(str, box)) for box in boxes[:3])
    return (f"the image seems to show {len(boxes)} objects: {ASK}, such as --box {named}",)


def _box(place: tuple[slice, slice], scale: float) -> Box:
    rows, columns = place
    edges = columns.start, rows.start, columns.stop, rows.stop
    left, top, right, bottom = (round(edge * scale) for edge in edges)
    return left, top, right, bottom
