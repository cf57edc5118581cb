"""A user's own images: validated, and brought to the shape that the predictors expect."""

from __future__ import annotations

import struct
import warnings
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from PIL import Image, ImageOps, UnidentifiedImageError

from grasptypes.errors import InputError
from grasptypes.settings.commands import PhotoLimits

# No formats that run another program (EPS) or are not for single screen images.
FORMATS = ("PNG", "JPEG", "WEBP", "BMP", "TIFF", "GIF", "PPM")
SUFFIXES = (".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tif", ".tiff", ".gif", ".ppm")
_MODES = ("1", "L", "P", "RGB", "CMYK", "YCbCr")
_BROKEN = (OSError, SyntaxError, ValueError, EOFError, IndexError, struct.error, zlib.error)


def photo_files(path: str | Path) -> list[Path]:
    """The file, or the images in a folder sorted by name, without hidden files.

    Raises:
        InputError: there is no image.
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
    """Check the header of an image only; raises InputError like :func:`read_photo`."""
    with _opened(path, limits):
        pass


def read_photo(path: str | Path, limits: PhotoLimits) -> np.ndarray:
    """Read an image as (S, S, 3) uint8, turned upright and padded to a square.

    The predictors were trained on square images, and squeezing an image would change the object's
    proportions. The padding has the median colour of the border.

    Raises:
        InputError: the file is not an image, is damaged, too small or too large, contains several
            images, or has an alpha channel (its background is undefined).
    """
    with _opened(path, limits) as opened:
        opened.draft("RGB", (limits.reduce_px, limits.reduce_px))
        opened.load()
        upright = ImageOps.exif_transpose(opened).convert("RGB")
    upright.thumbnail((limits.reduce_px, limits.reduce_px))
    return padded(np.asarray(upright))


@contextmanager
def _opened(path: str | Path, limits: PhotoLimits) -> Iterator[Image.Image]:
    """Open an image and check its header; any error becomes an InputError."""
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
    """An image (H, W, 3) centred in a square of the median colour of its border."""
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
    """Check the header only, before anything is decoded."""
    width, height = picture.size
    if min(width, height) < limits.min_px:
        message = f"is {width} x {height} pixels; each side needs at least {limits.min_px}"
        raise InputError(path, "", message)
    if width * height > limits.max_pixels:
        raise InputError(path, "", f"is {width} x {height} pixels; it {_too_large(limits)}")
    # A phone's JPEG may contain further images (MPO); the first one is the photograph.
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
