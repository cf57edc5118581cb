"""A user's own pictures: read with suspicion, and brought to the shape the predictors see."""

from __future__ import annotations

import struct
import warnings
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image, ImageOps, UnidentifiedImageError

from grasptypes.errors import InputError

# No format that runs another program (EPS) or holds anything but one picture for the screen.
FORMATS = ("PNG", "JPEG", "WEBP", "BMP", "TIFF", "GIF", "PPM")
SUFFIXES = (".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tif", ".tiff", ".gif", ".ppm")
_MODES = ("1", "L", "P", "RGB", "CMYK", "YCbCr")
_BROKEN = (OSError, SyntaxError, ValueError, EOFError, IndexError, struct.error, zlib.error)


class PhotoLimits(NamedTuple):
    """Which pictures are taken; the fields are keys of the `predict` section of params.yaml."""

    min_px: int
    """Shortest side."""
    max_pixels: int
    """Width times height."""
    reduce_px: int
    """Longer sides are reduced to this: the backbone sees far less."""


def photo_files(path: str | Path) -> list[Path]:
    """The file, or the pictures in a folder in the order of their names; hidden ones are none.

    Raises:
        InputError: there is nothing there.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(path, "", "no such file or folder")
    if path.is_file():
        return [path]
    files = sorted(
        file
        for file in path.iterdir()
        if file.suffix.lower() in SUFFIXES and not file.name.startswith(".") and file.is_file()
    )
    if not files:
        raise InputError(path, "", f"contains no image ({', '.join(SUFFIXES)})")
    return files


def check_photo(path: str | Path, limits: PhotoLimits) -> None:
    """Look at a picture's header alone; raises InputError as :func:`read_photo` does."""
    with _opened(path, limits):
        pass


def read_photo(path: str | Path, limits: PhotoLimits) -> np.ndarray:
    """A picture (S, S, 3) uint8, turned upright and padded to a square.

    The padding has the border's median colour: the predictors have learned on square pictures,
    and to squeeze a picture would change the object's proportions.

    Raises:
        InputError: not a picture, a damaged, too small or too large one, several in one file, or
            one with an alpha channel: what lies behind it is unknown, and a made-up ground would
            be guesswork.
    """
    with _opened(path, limits) as opened:
        opened.draft("RGB", (limits.reduce_px, limits.reduce_px))
        opened.load()
        upright = ImageOps.exif_transpose(opened).convert("RGB")
    upright.thumbnail((limits.reduce_px, limits.reduce_px))
    return padded(np.asarray(upright))


@contextmanager
def _opened(path: str | Path, limits: PhotoLimits) -> Iterator[Image.Image]:
    """A picture whose header has been looked at; what goes wrong with it becomes an InputError."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the size is checked below
        try:
            with Image.open(path, formats=FORMATS) as opened:
                _check(path, opened, limits)
                yield opened
        except InputError:
            raise
        except Image.DecompressionBombError as error:
            raise InputError(path, "", _too_large(limits)) from error
        except UnidentifiedImageError as error:
            raise InputError(path, "", f"not an image ({', '.join(FORMATS)})") from error
        except _BROKEN as error:
            raise InputError(path, "", f"cannot be read as an image: {error}") from error


def padded(picture: np.ndarray) -> np.ndarray:
    """A picture (H, W, 3) in the middle of a square of its border's median colour."""
    height, width = picture.shape[:2]
    if height == width:
        return picture
    size = max(height, width)
    border = [picture[0], picture[-1], picture[:, 0], picture[:, -1]]
    square = np.empty((size, size, 3), dtype=np.uint8)
    square[:] = np.median(np.concatenate(border), axis=0)
    top, left = (size - height) // 2, (size - width) // 2
    square[top : top + height, left : left + width] = picture
    return square


def _check(path: str | Path, picture: Image.Image, limits: PhotoLimits) -> None:
    """Look at the header alone, before anything is decoded."""
    width, height = picture.size
    if min(width, height) < limits.min_px:
        message = f"is {width} x {height} pixels; each side needs at least {limits.min_px}"
        raise InputError(path, "", message)
    if width * height > limits.max_pixels:
        raise InputError(path, "", f"is {width} x {height} pixels; it {_too_large(limits)}")
    # A phone's JPEG may carry further pictures (MPO), of which the first is the photograph.
    if picture.format != "MPO" and getattr(picture, "is_animated", False):
        message = "contains several images (an animation or pages): save the one you mean"
        raise InputError(path, "", message)
    if picture.has_transparency_data:
        message = (
            "has an alpha channel, so its background is undefined: save it on a background "
            "(e.g. magick in.png -background white -alpha remove out.png)"
        )
        raise InputError(path, "", message)
    if picture.mode not in _MODES:
        message = f"has mode {picture.mode}; allowed: 8 bits per channel, grey or colour"
        raise InputError(path, "", message)


def _too_large(limits: PhotoLimits) -> str:
    return f"exceeds the limit of {limits.max_pixels / 1e6:g} million pixels"
