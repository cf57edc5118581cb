"""Mistakes in images given to `grasptypes predict`."""

from __future__ import annotations

import io
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
from case import ROOT, Case, Content
from PIL import Image

from grasptypes.__main__ import main

NOISE = np.random.default_rng(0).integers(0, 256, (64, 64, 3), dtype=np.uint8)


def command(*arguments: str) -> Callable[[], None]:
    """`grasptypes ...` in the folder of the files."""
    return lambda: main(arguments)


def encoded(picture: Image.Image, kind: str = "png", **options: Any) -> bytes:
    """The bytes of an image file."""
    buffer = io.BytesIO()
    picture.save(buffer, kind, **options)
    return buffer.getvalue()


def picture(what: str, content: Content, *names: str, name: str = "cup.png") -> Case:
    """An image that is named."""
    files = {
        name: content,
        "params.yaml": (ROOT / "params.yaml").read_bytes(),
    }
    call = command("predict", name, "--task", "use")
    return Case("image", what, files, call, (name, *names))


STILL = Image.fromarray(NOISE)
TWO = {"save_all": True, "append_images": [Image.fromarray(NOISE[::-1])]}
WHOLE = encoded(Image.fromarray(NOISE))
HEIC = b"\0\0\0\x18ftypheic\0\0\0\0mif1heic" + bytes(100)
# The number of samples per pixel is tag 277.
CHANNELS = encoded(STILL, "tiff").replace(
    struct.pack("<HHII", 277, 3, 1, 3), struct.pack("<HHII", 277, 3, 1, 64)
)
CASES = [
    picture("empty", b"", "not an image"),
    picture("text named .png", "a cup\n", "not an image"),
    picture("truncated", WHOLE[: len(WHOLE) // 2], "cannot be read as an image"),
    picture("damaged", WHOLE[:60] + bytes(20) + WHOLE[80:], "cannot be read as an image"),
    picture("too small", encoded(Image.new("RGB", (1, 1))), "1 x 1 pixels", "at least 32"),
    picture("too large", encoded(Image.new("1", (20_000, 10_000))), "limit of 110 million pixels"),
    picture("transparent pixels", encoded(Image.new("RGBA", (64, 64))), "transparent pixels"),
    picture("HEIC named .jpg", HEIC, "HEIC", "save it as JPEG", name="cup.jpg"),
    picture("a TIFF of 64 channels", CHANNELS, "not an image", name="cup.tif"),
    picture("an animation", encoded(STILL, "gif", **TWO), "several images", name="cup.gif"),
    picture("several pages", encoded(STILL, "tiff", **TWO), "several images", name="cup.tif"),
    picture(
        "16 bits a channel",
        encoded(Image.fromarray(NOISE[..., 0].astype(np.uint16) * 256)),
        "8 bits",
    ),
    picture(
        "a format that runs a program", "%!PS-Adobe-3.0 EPSF-3.0\n", "not an image", name="cup.eps"
    ),
]
