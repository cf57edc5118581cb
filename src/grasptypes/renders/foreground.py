"""How many objects an image shows, by a simple rule: what the largest even region encloses.

It knows nothing about objects: patterns, hard shadows and objects that touch mislead it. Where
nothing is even, or objects reach the image's border, it says nothing.
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
    slopes = [ndimage.gaussian_gradient_magnitude(small[..., k], 1.0) for k in range(3)]
    even, _ = ndimage.label(np.max(slopes, axis=0) < settings.edge)
    sizes = np.bincount(even.ravel(), minlength=2)
    ground = even == 1 + np.argmax(sizes[1:])
    if ground.mean() < settings.ground:
        return None
    enclosed = ndimage.binary_opening(ndimage.binary_fill_holes(ground) & ~ground)
    labels, _ = ndimage.label(enclosed, np.ones((3, 3)))
    sizes = np.bincount(labels.ravel())[1:]
    least = max(settings.least * labels.size, settings.relative * max(sizes, default=0))
    places, scale = ndimage.find_objects(labels), picture.shape[1] / small.shape[1]
    order = [k for k in np.argsort(-sizes, kind="stable") if sizes[k] >= least]
    if not order and ground.mean() < settings.empty:
        return None
    return [_box(places[k], scale) for k in order]


def doubts(picture: np.ndarray, settings: ForegroundSettings) -> tuple[str, ...]:
    """What is to be said about an image (H, W, 3) of which no part was named."""
    boxes = objects_in(picture, settings)
    if boxes is None:
        return ()
    if not boxes:
        return (f"the image seems to show no object, only a background: {ASK}",)
    named = " or ".join(",".join(map(str, box)) for box in boxes[:3])
    if len(boxes) > 1:
        return (f"the image seems to show {len(boxes)} objects: {ASK}, such as --box {named}",)
    left, top, right, bottom = boxes[0]
    if max(right - left, bottom - top) < settings.far * max(picture.shape[:2]):
        return (f"the object seems to be a small part of the image: {ASK}, such as --box {named}",)
    return ()


def _box(place: tuple[slice, slice], scale: float) -> Box:
    rows, columns = place
    edges = columns.start, rows.start, columns.stop, rows.stop
    left, top, right, bottom = (round(edge * scale) for edge in edges)
    return left, top, right, bottom
