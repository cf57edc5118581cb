"""A user's own images: validated, and brought to the shape that the predictors expect."""

from __future__ import annotations

import contextlib
import struct
import warnings
import zlib
from collections.abc import Collection, Iterator
from pathlib import Path

import numpy as np
from PIL import ExifTags, Image, ImageColor, ImageOps, UnidentifiedImageError

from grasptypes.errors import InputError, parsing
from grasptypes.settings.commands import PhotoLimits

# No formats that run another program (EPS) or are not for single screen images.
FORMATS = ("PNG", "JPEG", "WEBP", "BMP", "TIFF", "GIF", "PPM")
_MODES = ("1", "L", "LA", "P", "PA", "RGB", "RGBA", "CMYK", "YCbCr")
# Left, top, right and bottom of a part of an image, in pixels from its upper left corner.
Box = tuple[int, int, int, int]
# Where images keep metadata, and how HEIC and AVIF begin.
_METADATA = ("exif", "Raw profile type exif", "xmp", "XML:com.adobe.xmp")
_PHONE_FORMATS = (b"heic", b"heix", b"heim", b"heis", b"hevc", b"mif1", b"msf1", b"avif", b"avis")
_BROKEN = (OSError, SyntaxError, ValueError, EOFError, IndexError, struct.error, zlib.error)


def photo_files(path: str | Path) -> tuple[list[Path], dict[Path, str]]:
    """The file, or the files in a folder, sorted by name; their content decides what is an image.

    Returns:
        The files, and the folder's other entries with the reason why each is skipped.

    Raises:
        InputError: there is no file.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(path, "", "no such file or folder")
    if path.is_file():
        return [path], {}
    files, skipped = [], {}
    for entry in sorted(path.iterdir()):
        if entry.name.startswith("."):
            skipped[entry] = "a hidden file"
        elif not entry.is_file():
            skipped[entry] = "not a file"
        else:
            files.append(entry)
    if not files:
        raise InputError(path, "", f"contains no image ({', '.join(FORMATS)})")
    return files, skipped


def read_background(colour: str) -> tuple[int, int, int]:
    """The RGB values of a colour's name or code, e.g. white or #ff8800.

    Raises:
        InputError: no such opaque colour.
    """
    try:
        values = ImageColor.getrgb(colour)
    except ValueError as error:
        message = "is not a colour: use a name (white) or a code (#ffffff)"
        raise InputError("--background", colour, message) from error
    if len(values) != 3:
        raise InputError("--background", colour, "must be opaque")
    return values


def check_photo(
    path: str | Path, limits: PhotoLimits, background: tuple[int, int, int] | None = None
) -> None:
    """Check the header of an image, and its pixels if they may be transparent.

    Raises:
        InputError: see :func:`read_photo`.
    """
    with opened_image(path, limits) as opened:
        _check_opaque(path, opened, background)


def read_photo(
    path: str | Path,
    limits: PhotoLimits,
    background: tuple[int, int, int] | None = None,
    box: Box | None = None,
) -> np.ndarray:
    """Read an image as (S, S, 3) uint8, turned upright and padded to a square.

    The predictors were trained on square images, and squeezing an image would change the object's
    proportions. The padding has the median colour of the border.

    Args:
        background: RGB colour behind transparent pixels.
        box: the part of the upright image to read; it must show at least a pixel.

    Raises:
        InputError: the file is not an image, is damaged, too small or too large, contains several
            images, has transparent pixels and no background is given, or does not contain the box.
    """
    upright = _read(path, limits, background, reduce=box is None)
    if box is not None:
        inside = 0 <= box[0] < box[2] <= upright.width and 0 <= box[1] < box[3] <= upright.height
        if not inside:
            size = f"{upright.width} x {upright.height} pixels"
            raise InputError(path, "box", f"{box} is not a part of the image, which has {size}")
        upright = upright.crop(box)
    upright.thumbnail((limits.reduce_px, limits.reduce_px))
    return padded(np.asarray(upright))


def read_whole(
    path: str | Path, limits: PhotoLimits, background: tuple[int, int, int] | None = None
) -> np.ndarray:
    """Read an image as (H, W, 3) uint8 in its own shape and size, turned upright; raises alike."""
    return np.asarray(_read(path, limits, background, reduce=False))


def _read(
    path: str | Path, limits: PhotoLimits, background: tuple[int, int, int] | None, reduce: bool
) -> Image.Image:
    """The image in RGB, upright; `reduce` lets JPEG files be read in fewer pixels."""
    with opened_image(path, limits) as opened:
        if reduce:
            opened.draft("RGB", (limits.reduce_px, limits.reduce_px))
        opened.load()
        _check_opaque(path, opened, background)
        upright = _upright(path, opened)
        if background is not None and upright.has_transparency_data:
            behind = Image.new("RGBA", upright.size, background)
            upright = Image.alpha_composite(behind, upright.convert("RGBA"))
        return upright.convert("RGB")


@contextlib.contextmanager
def opened_image(
    path: str | Path, limits: PhotoLimits, modes: Collection[str] = _MODES
) -> Iterator[Image.Image]:
    """Open an image and check its header; any error becomes an InputError."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the size is checked below
        try:
            with Image.open(path, formats=FORMATS) as opened:
                _check(path, opened, limits, modes)
                yield opened
        except InputError:
            raise
        except Image.DecompressionBombError as error:
            raise InputError(path, "", _too_large(limits)) from error
        except UnidentifiedImageError as error:
            raise InputError(path, "", _unknown(path)) from error
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


def _check(
    path: str | Path, picture: Image.Image, limits: PhotoLimits, modes: Collection[str]
) -> None:
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
    if picture.mode not in modes:
        allowed = "8 bits per channel, grey or colour" if modes is _MODES else "16 bits, grey"
        message = f"has mode {picture.mode}; allowed: {allowed}"
        raise InputError(path, "", message)


def _upright(path: str | Path, picture: Image.Image) -> Image.Image:
    """The image, turned as its metadata say; damaged metadata do not matter."""
    plain, orientation = picture.copy(), _orientation(path, picture)
    for name in _METADATA:
        plain.info.pop(name, None)
    plain.getexif()[ExifTags.Base.Orientation] = orientation
    return ImageOps.exif_transpose(plain)


def is_turned(path: str | Path, limits: PhotoLimits) -> bool:
    """Whether the metadata of an image turn it."""
    with opened_image(path, limits) as opened:
        return _orientation(path, opened) not in (None, 1)


def _orientation(path: str | Path, picture: Image.Image) -> int | None:
    found: int | None = None
    with contextlib.suppress(InputError), parsing(path, "has damaged metadata"):
        found = picture.getexif().get(ExifTags.Base.Orientation)
    return found


def _unknown(path: str | Path) -> str:
    """Why a file of unknown content is rejected."""
    with Path(path).open("rb") as file:
        start = file.read(12)
    if start[4:8] == b"ftyp" and start[8:] in _PHONE_FORMATS:
        return "is a HEIC or AVIF image, which cannot be read: save it as JPEG or PNG"
    return f"not an image ({', '.join(FORMATS)})"


def _check_opaque(
    path: str | Path, picture: Image.Image, background: tuple[int, int, int] | None
) -> None:
    """Reject transparent pixels whose background is unknown. An alpha of 255 hides nothing."""
    if background is not None or not picture.has_transparency_data:
        return
    if np.asarray(picture.convert("RGBA").getchannel("A")).min() < 255:
        message = "has transparent pixels: name the colour behind them, e.g. --background white"
        raise InputError(path, "", message)


def _too_large(limits: PhotoLimits) -> str:
    return f"exceeds the limit of {limits.max_pixels / 1e6:g} million pixels"
