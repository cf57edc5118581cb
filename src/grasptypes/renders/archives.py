"""Archives of images, as the workflow keeps them: one ZIP file per object or kind."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from grasptypes.errors import InputError

Picture = NDArray[np.uint8]


def read_named_pictures(path: str | Path, names: Iterable[str] | None = None) -> dict[str, Picture]:
    """Images (H, W, 3) of an archive by file name, in the archive's order.

    Args:
        names: those wanted, in this order; all by default.

    Raises:
        InputError: the file is not an archive, or a member is not an image.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            wanted = archive.namelist() if names is None else names
            members = {name: archive.read(name) for name in wanted}
    except (OSError, zipfile.BadZipFile) as error:
        raise InputError(path, "", f"cannot be read as a ZIP archive: {error}") from error
    return {name: _decoded(content, path, name) for name, content in members.items()}


def read_pictures(path: str | Path) -> Picture:
    """Images of an archive, all of one size, sorted by name: (N, H, W, 3).

    Raises:
        InputError: the file is not an archive, contains nothing, or a member is not an image.
    """
    named = read_named_pictures(path)
    if not named:
        raise InputError(path, "", "contains no images")
    return np.stack([named[name] for name in sorted(named)])


def _decoded(content: bytes, path: str | Path, name: str) -> Picture:
    try:
        with Image.open(io.BytesIO(content)) as picture:
            return np.asarray(picture.convert("RGB"))
    except (UnidentifiedImageError, OSError) as error:
        raise InputError(path, name, f"not an image: {error}") from error
