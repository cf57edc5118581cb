"""Mistakes in what is shown to `grasptypes predict`: parts of images, depth, sizes, points."""

from __future__ import annotations

import io
import json
import struct
import zlib
from typing import Any

import numpy as np
from case import ROOT, Case, Content
from mesh_cases import STL
from picture_cases import NOISE, STILL, WHOLE, command, encoded
from PIL import ExifTags, Image

FOLDER = {"params.yaml": (ROOT / "params.yaml").read_bytes(), "cup.png": WHOLE}
DEPTH_MM = np.full((64, 64), 700, dtype=np.uint16)
DEPTH_MM[16:48, 16:48] = 600
SQUARE = np.zeros((64, 64), dtype=np.uint8)
SQUARE[16:48, 16:48] = 255
CAMERA = {"fx": 525.0, "fy": 525.0, "cx": 32.0, "cy": 32.0}
MASK = encoded(Image.fromarray(SQUARE))
MEASURED = ("--mask", "mask.png", "--depth", "d.png", "--intrinsics", "K.json")


def shown(what: str, arguments: tuple[str, ...], *names: str, **files: Content) -> Case:
    """A call of `grasptypes predict` about `cup.png`; files are named like `mask_png`."""
    more = {name.replace("_", "."): content for name, content in files.items()}
    words = ("predict", "cup.png", "--task", "use", *arguments)
    return Case("prediction", what, FOLDER | more, command(*words), names)


def file(what: str, name: str, content: Content, *names: str, more: tuple[str, ...] = ()) -> Case:
    """A call of `grasptypes predict` about one file."""
    words = ("predict", name, "--task", "use", *more)
    return Case("prediction", what, FOLDER | {name: content}, command(*words), (*names,))


def measured(what: str, *names: str, **files: Content) -> Case:
    """A call with mask, depth and intrinsics, of which some are wrong."""
    good = {"mask_png": MASK, "d_png": png(DEPTH_MM), "K_json": json.dumps(CAMERA)}
    return shown(what, MEASURED, *names, **(good | files))


def measured_array(what: str, array: Any, *names: str) -> Case:
    """A call whose depth image is an NPY file."""
    arguments = ("--mask", "mask.png", "--depth", "d.npy", "--intrinsics", "K.json")
    files: dict[str, Content] = {"mask_png": MASK, "K_json": json.dumps(CAMERA)}
    return shown(what, arguments, *names, d_npy=npy(array), **files)


def png(array: np.ndarray) -> bytes:
    return encoded(Image.fromarray(array))


def npy(array: Any) -> bytes:
    buffer = io.BytesIO()
    np.save(buffer, array, allow_pickle=True)
    return buffer.getvalue()


def with_camera(**changes: Any) -> str:
    return json.dumps(CAMERA | changes)


def chunk(kind: bytes, content: bytes) -> bytes:
    ends = struct.pack(">I", zlib.crc32(kind + content))
    return struct.pack(">I", len(content)) + kind + content + ends


def bomb(side: int) -> bytes:
    """A PNG of a few bytes that states a huge image."""
    head = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    parts = chunk(b"IHDR", head), chunk(b"IDAT", zlib.compress(b"")), chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def turned() -> bytes:
    """A JPEG of 96 x 64 pixels that its metadata turn to 64 x 96."""
    exif = Image.Exif()
    exif[ExifTags.Base.Orientation] = 6
    wide = Image.fromarray(np.hstack([NOISE, NOISE[:, :32]]))
    return encoded(wide, "jpeg", exif=exif)


def ply(points: int) -> str:
    head = "ply\nformat ascii 1.0\nelement vertex {}\n{}end_header\n"
    names = "".join(f"property float {axis}\n" for axis in "xyz")
    rows = np.random.default_rng(0).random((points, 3)) / 10
    return head.format(points, names) + "".join(f"{x} {y} {z}\n" for x, y, z in rows)


POINTS = np.random.default_rng(0).random((200, 3)) / 10
HOLES = DEPTH_MM.copy()
HOLES[16:48, 16:42] = 0
METRES = DEPTH_MM / 1000
CASES = [
    # sizes
    shown("a size of three kilometres", ("--size", "3000m"), "--size: 3000 m: must be 0.001 to 2"),
    shown("a size of nothing", ("--size", "0cm"), "--size: 0 m: must be"),
    shown("a size without unit", ("--size", "12"), "--size: 12: has no unit; allowed: m, cm"),
    shown("a size in an unknown unit", ("--size", "3ell"), "'ell' is no unit; allowed: m, cm, mm"),
    shown("a size of two lengths", ("--size", "12x5cm"), "--size: 2", "or all three"),
    shown("a size of four lengths", ("--size", "1x2x3x4cm"), "--size: 4", "or all three"),
    shown("a size in words", ("--size", "big"), "--size: big: must be a length or all three"),
    shown("a negative size", ("--size=-3cm",), "--size: -3cm: must be a length"),
    shown("a mass of a tonne", ("--mass-kg", "1000"), "--mass-kg: 1000 kg: must be 0.001 to 25"),
    shown("the option that --size replaces", ("--size-m", "0.1"), "unrecognized", "--size-m"),
    file("a size for a mesh", "cup.stl", STL, "--size: 3cm: is for", more=("--size", "3cm")),
    # boxes and masks
    shown("a box in words", ("--box", "left"), "--box: left: must be left,top,right,bottom"),
    shown("a box of three numbers", ("--box", "1,2,3"), "--box: 1,2,3: must be"),
    shown("a box beside the image", ("--box", "0,0,64,65"), "--box: 0,0,64,65", "64 x 64 pixels"),
    shown("a box from right to left", ("--box", "40,0,8,64"), "is not a part of the image"),
    shown("a box of a few pixels", ("--box", "0,0,5,5"), "is 5 x 5 pixels", "at least 32"),
    shown(
        "a box and a mask",
        ("--box", "0,0,40,40", "--mask", "mask.png"),
        "--box: has no effect beside --mask",
        mask_png=MASK,
    ),
    file("a box for a mesh", "cup.stl", STL, "--box: is for images", more=("--box", "0,0,40,40")),
    file(
        "a box for an image that is turned",
        "wide.jpg",
        turned(),
        "--box: 0,0,96,64",
        "64 x 96 pixels",
        more=("--box", "0,0,96,64"),
    ),
    shown("a missing mask", ("--mask", "no.png"), "no.png: no such file"),
    shown("an empty mask", ("--mask", "m.png"), "m.png: is empty", m_png=png(SQUARE * 0)),
    shown(
        "a mask of 0 and 1",
        ("--mask", "m.png"),
        "is empty: it is white no",
        m_png=png(SQUARE // 255),
    ),
    shown("a mask of everything", ("--mask", "m.png"), "everywhere", m_png=png(SQUARE * 0 + 255)),
    shown(
        "a mask of another shape",
        ("--mask", "m.png"),
        "m.png: has 64 x 32 pixels, but the image 64 x 64",
        m_png=png(SQUARE[:32]),
    ),
    shown("a mask that is text", ("--mask", "m.png"), "m.png: not an image", m_png="white"),
    shown(
        "a mask with transparent pixels",
        ("--mask", "m.png"),
        "m.png: has transparent pixels",
        m_png=encoded(Image.new("RGBA", (64, 64))),
    ),
    shown(
        "a mask of a few pixels",
        ("--mask", "m.png"),
        "m.png: 0,0,5,5: is 5 x 5 pixels",
        m_png=png(np.pad(np.full((5, 5), 255, np.uint8), (0, 59))),
    ),
    # depth
    shown("depth without intrinsics", MEASURED[:4], "needs --intrinsics", mask_png=MASK, d_png=b""),
    shown("intrinsics without depth", ("--intrinsics", "K.json"), "is for depth images"),
    shown(
        "depth without box and mask", MEASURED[2:], "needs --mask or --box", d_png=b"", K_json="{}"
    ),
    shown("depth and a size", ("--size", "9cm", "--depth", "d.png"), "measured in the depth image"),
    measured("depth of 8 bits", "d.png: has mode L; allowed: 16 bits", d_png=png(SQUARE)),
    measured("depth in colours", "d.png: has mode RGB; allowed: 16 bits", d_png=WHOLE),
    measured("depth that is text", "d.png: not an image", d_png="0.7"),
    measured("depth in metres as integers", "is 0.002 m away", d_png=png(DEPTH_MM // 300)),
    measured("depth in tenths of a millimetre", "is 60 m away; must be", d_png=png(DEPTH_MM * 100)),
    measured("depth with holes", "no depth for 81% of the object", d_png=png(HOLES)),
    measured("depth of holes only", "no depth for 100%", d_png=png(DEPTH_MM * 0)),
    measured("depth of another shape", "--depth: has 64 x 32 pixels", d_png=png(DEPTH_MM[:32])),
    measured_array("depth in millimetres as floats", METRES * 1000, "is 600 m away", "metres"),
    measured_array("depth of signed integers", METRES.astype(int), "d.npy: holds int64"),
    measured_array("negative depth", -METRES, "d.npy: has negative distances"),
    measured_array("depth with channels", np.dstack([METRES] * 3), "d.npy: has shape (64, 64, 3)"),
    measured_array("depth of NaN", METRES * np.nan, "no depth for 100% of the object"),
    measured_array("a pickle as depth", np.array([{}]), "d.npy: not an array"),
    shown(
        "an object that is flat",
        ("--box", "0,0,64,64", "--depth", "d.npy", "--intrinsics", "K.json"),
        "nothing stands out of a plane",
        d_npy=npy(np.full((64, 64), 0.7)),
        K_json=json.dumps(CAMERA),
    ),
    measured(
        "an object as large as a house",
        "measures 3",
        d_png=png(DEPTH_MM * 10),
        K_json=with_camera(fx=60.0, fy=60.0),
    ),
    shown(
        "missing depth",
        ("--mask", "mask.png", "--depth", "no.png", "--intrinsics", "K.json"),
        "no.png: no such file",
        mask_png=MASK,
        K_json=json.dumps(CAMERA),
    ),
    file(
        "depth for an image that is turned",
        "wide.jpg",
        turned(),
        "wide.jpg: is turned by its metadata",
        more=("--box", "0,0,40,40", "--depth", "d.png"),
    ),
    # intrinsics
    measured("intrinsics that are no JSON", "K.json: is not a JSON file", K_json="fx: 525"),
    measured(
        "intrinsics without numbers", "K.json: has no intrinsics", K_json='{"name": "kinect"}'
    ),
    measured("a matrix of 2 x 2", "K.json: has no intrinsics", K_json="[[525, 0], [0, 525]]"),
    measured("a negative focal length", "K.json: fx, fy: must be", K_json=with_camera(fx=-525.0)),
    measured("a focal length in metres", "too short", K_json=with_camera(fx=0.004, fy=0.004)),
    measured(
        "intrinsics of another camera",
        "K.json: cx, cy: 319.5, 239.5",
        K_json=with_camera(cx=319.5, cy=239.5),
    ),
    measured(
        "intrinsics of another resolution",
        "K.json: width, height: are 640 x 480, but the depth image is 64 x 64",
        K_json=with_camera(width=640, height=480),
    ),
    # images
    file("a decompression bomb", "cup.png", bomb(60_000), "cup.png", "exceeds the limit of 110"),
    file("a smaller bomb", "cup.png", bomb(12_000), "is 12000 x 12000 pixels; it exceeds"),
    file(
        "colours of floats",
        "cup.tif",
        encoded(Image.fromarray(METRES.astype(np.float32)), "tiff"),
        "mode F",
    ),
    file("an icon", "cup.ico", encoded(STILL, "ico"), "cup.ico: not an image"),
    file("a film", "cup.mp4", b"\0\0\0\x20ftypisom\0\0\2\0isomiso2", "cup.mp4: not an image"),
    file("a JPEG without its end", "cup.jpg", encoded(STILL, "jpeg")[:700], "cannot be read as an"),
    file("a web page named .jpg", "cup.jpg", "<html>Not found</html>", "cup.jpg: not an image"),
    Case(
        "prediction",
        "a box for two images",
        FOLDER | {"b.png": WHOLE},
        command("predict", "cup.png", "b.png", "--task", "use", "--box", "0,0,40,40"),
        ("--box: is for one image, but there are 2",),
    ),
    Case(
        "prediction",
        "an explanation of two objects",
        FOLDER | {"b.png": WHOLE},
        command("predict", "cup.png", "b.png", "--task", "use", "--explain", "e.png"),
        ("--explain: is for one object",),
    ),
    shown(
        "an explanation over the image", ("--explain", "cup.png"), "cup.png: is one of the input"
    ),
    shown("an explanation as JPEG", ("--explain", "e.jpg"), "e.jpg: must end in .png"),
    # points
    file("points as text", "p.npy", "0 0 0", "p.npy: not an array"),
    file("points in a plane", "p.npy", npy(POINTS * [1, 1, 0]), "lie in a plane"),
    file("points of two coordinates", "p.npy", npy(POINTS[:, :2]), "points need (N, 3) numbers"),
    file("ten points", "p.ply", ply(10), "p.ply: has 10 points; must be 50 to"),
    file("points of NaN", "p.npy", npy(POINTS * np.nan), "p.npy: has 0 points"),
    file("points in millimetres", "p.npy", npy(POINTS * 1000), "must be 0.001 to 2 m (--unit)"),
    file("a PLY that is cut", "p.ply", ply(200)[:900], "p.ply"),
]
