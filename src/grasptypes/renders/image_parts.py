"""The part of an image that shows the object: a box or a mask that the user names."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.renders.photos import Box, opened_image
from grasptypes.settings.commands import PhotoLimits


def read_box(text: str) -> Box:
    """Left, top, right and bottom in pixels, such as 120,80,420,360.

    Raises:
        InputError: the text is no such box.
    """
    try:
        left, top, right, bottom = (int(word) for word in text.split(","))
    except ValueError as error:
        message = "must be left,top,right,bottom in pixels, such as 120,80,420,360"
        raise InputError("--box", text, message) from error
    return left, top, right, bottom


def check_box(box: Box, shape: tuple[int, int], least_px: int, file: str | Path = "--box") -> None:
    """Check that a box is a part of an image of some height and width.

    Args:
        file: the option, or the mask, that the box is from.

    Raises:
        InputError: it is not, or is too small.
    """
    left, top, right, bottom = box
    words = ",".join(map(str, box))
    height, width = shape
    if not (0 <= left < right <= width and 0 <= top < bottom <= height):
        message = f"is not a part of the image, which has {width} x {height} pixels"
        raise InputError(file, words, message)
    if min(right - left, bottom - top) < least_px:
        message = f"is {right - left} x {bottom - top} pixels; each side needs at least {least_px}"
        raise InputError(file, words, message)


def read_mask(path: str | Path, limits: PhotoLimits) -> np.ndarray:
    """An image file as a mask (H, W) bool: what is brighter than half shows the object.

    Raises:
        InputError: the file is no image.
    """
    if not Path(path).is_file():
        raise InputError(path, "", "no such file")
    with opened_image(path, limits) as opened:
        opened.load()
        if opened.has_transparency_data:
            message = "has transparent pixels: a mask is white where the object is, black elsewhere"
            raise InputError(path, "", message)
        return np.asarray(opened.convert("L")) > 127


def check_mask(mask: np.ndarray, shape: tuple[int, int], file: str | Path) -> None:
    """Check that a mask has the shape (H, W) of an image, and shows a part of it.

    Raises:
        InputError: it does not.
    """
    if mask.ndim != 2 or mask.shape != shape:
        said = " x ".join(map(str, mask.shape[::-1]))
        message = f"has {said} pixels, but the image {shape[1]} x {shape[0]}: both must be the same"
        raise InputError(file, "", message)
    if not mask.any():
        raise InputError(file, "", "is empty: it is white nowhere, so it shows no object")
    if mask.all():
        raise InputError(file, "", "is white everywhere: leave it out")


def box_of(mask: np.ndarray) -> Box:
    """The smallest box that contains a mask."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1


def cut(picture: np.ndarray, box: Box) -> np.ndarray:
    """The part of an image (H, W, 3) that a box names."""
    left, top, right, bottom = box
    return picture[top:bottom, left:right]


def reduced(picture: np.ndarray, size_px: int) -> np.ndarray:
    """An image with sides of at most `size_px`."""
    if max(picture.shape[:2]) <= size_px:
        return picture
    small = Image.fromarray(picture)
    small.thumbnail((size_px, size_px))
    return np.asarray(small)
