"""Contact sheets: images with captions, in groups with headings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

INK, WARNING = "#202020", "#b00020"
# Letter heights as shares of an image's height, and the smallest legible one in pixels.
CAPTION_SHARE, HEADING_SHARE, LEAST_PX = 0.075, 0.11, 12
# Line height as a multiple of the letter height, and left margin in pixels.
LINE, MARGIN_PX = 1.5, 5
# Factor by which letters that do not fit shrink.
SMALLER = 0.97


class Tile(NamedTuple):
    """An image (H, W, 3) uint8 and its caption, with as many lines as those beside it."""

    picture: NDArray[np.uint8]
    caption: str
    colour: str = INK


class Group(NamedTuple):
    """Images that start a new row, with an optional heading."""

    heading: str
    tiles: Sequence[Tile]


def sheet(groups: Sequence[Group], columns: int, height_px: int) -> NDArray[np.uint8]:
    """All groups below each other, with images in rows of `columns`, each `height_px` high.

    All images get the width of the first one, scaled to the height.

    Returns:
        (H, W, 3) image.
    """
    shapes = [tile.picture.shape for group in groups for tile in group.tiles] or [(1, 1)]
    width_px = round(shapes[0][1] * height_px / shapes[0][0])
    bands = []
    for group in groups:
        if group.heading:
            bands.append(_text(group.heading, columns * width_px, height_px * HEADING_SHARE, INK))
        tiles = [_tile(tile, width_px, height_px) for tile in group.tiles]
        for at in range(0, len(tiles), columns):
            row = tiles[at : at + columns]
            bands.append(np.hstack(row + [np.full_like(row[0], 255)] * (columns - len(row))))
    return np.vstack(bands)


def _tile(tile: Tile, width_px: int, height_px: int) -> NDArray[np.uint8]:
    shrunk = Image.fromarray(tile.picture).resize((width_px, height_px), Image.Resampling.LANCZOS)
    letters_px = height_px * CAPTION_SHARE
    lines = [_text(line, width_px, letters_px, tile.colour) for line in tile.caption.split("\n")]
    return np.vstack([*lines, np.asarray(shrunk)])


def _text(text: str, width_px: int, letters_px: float, colour: str) -> NDArray[np.uint8]:
    """A line of text, with smaller letters if it would not fit."""
    letters_px = max(letters_px, LEAST_PX)
    line = Image.new("RGB", (width_px, round(letters_px * LINE)), "white")
    draw = ImageDraw.Draw(line)
    # Hinted letters are not as wide as their size says, so the length is measured at every size.
    while (
        letters_px > 1
        and draw.textlength(text, ImageFont.load_default(letters_px)) > width_px - 2 * MARGIN_PX
    ):
        letters_px *= SMALLER
    at = MARGIN_PX, line.height / 2
    draw.text(at, text, fill=colour, font=ImageFont.load_default(letters_px), anchor="lm")
    return np.asarray(line)
