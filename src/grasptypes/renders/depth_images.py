"""Depth images of a user's camera, in the encodings of ROS: how far things are, and how large.

`16UC1` is uint16 millimetres with holes of 0, `32FC1` floating point metres with holes of NaN
(REP 118). A PNG file holds the first, an NPY file either.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from grasptypes.errors import InputError, parsing
from grasptypes.renders.photos import Box, opened_image
from grasptypes.settings.commands import DepthLimits, PhotoLimits

MILLIMETRES = 1000.0
_PNG_MODES = ("I;16", "I;16B", "I;16L", "I;16N")
UNITS = "16-bit integers are read as millimetres, floating point numbers as metres"
# Rounds in which pixels that do not lie in the ground's plane are dropped from its fit.
ROUNDS = 5
BORDER_PX = 2


@dataclass(frozen=True)
class Intrinsics:
    """A pinhole camera, in pixels; `shape` is the height and width of its images, if known."""

    focal: tuple[float, float]
    centre: tuple[float, float]
    shape: tuple[int, int] | None = None


def read_intrinsics(path: str | Path) -> Intrinsics:
    """Read `{"fx", "fy", "cx", "cy"}`, a 3 x 3 matrix, or ROS's CameraInfo (`K` or `k`) as JSON.

    `width` and `height` are optional. Distortion is not corrected.

    Raises:
        InputError: the file has none of these, or numbers that no camera has.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(path, "", "no such file")
    with parsing(path, "is not a JSON file"):
        content: Any = json.loads(path.read_bytes())
    with parsing(path, "has no intrinsics: fx, fy, cx and cy, or a 3 x 3 matrix K"):
        found = content if isinstance(content, dict) else {"K": content}
        named = [found.get(name) for name in ("fx", "fy", "cx", "cy")]
        if None in named:
            matrix = np.array(found.get("K", found.get("k")), dtype=float).reshape(3, 3)
            named = [matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2]]
        fx, fy, cx, cy = (float(number) for number in named)  # type: ignore[arg-type]
        sides = [found.get(name) for name in ("height", "width")]
        shape = None if None in sides else (int(sides[0]), int(sides[1]))  # type: ignore[arg-type]
    if not (0 < fx < np.inf and 0 < fy < np.inf):
        raise InputError(path, "fx, fy", "must be positive: focal lengths in pixels")
    return Intrinsics((fx, fy), (cx, cy), shape)


def read_depth(path: str | Path, limits: PhotoLimits) -> np.ndarray:
    """Distances (H, W) along the camera's axis in metres; NaN where there is none.

    Raises:
        InputError: the file is no depth image.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(path, "", "no such file")
    if path.suffix.lower() == ".npy":
        raw = _read_array(path, limits)
    else:
        with opened_image(path, limits, _PNG_MODES) as opened:
            opened.load()
            raw = np.asarray(opened).astype(np.uint16)
    if raw.dtype == np.uint16:
        return np.where(raw == 0, np.nan, raw / MILLIMETRES)
    found = raw.astype(np.float64)
    if (found[np.isfinite(found)] < 0).any():
        raise InputError(path, "", "has negative distances")
    return np.where(np.isfinite(found) & (found > 0), found, np.nan)


def _read_array(path: Path, limits: PhotoLimits) -> np.ndarray:
    with parsing(path, "not an array"):
        mapped = np.load(path, mmap_mode="r", allow_pickle=False)
    if mapped.ndim != 2 or 0 in mapped.shape:
        message = f"has shape {mapped.shape}; a depth image has height and width"
        raise InputError(path, "", message)
    if mapped.size > limits.max_pixels:
        raise InputError(path, "", f"has {mapped.size} pixels; at most {limits.max_pixels}")
    if mapped.dtype not in (np.uint16, np.float32, np.float64):
        raise InputError(path, "", f"holds {mapped.dtype}; {UNITS}")
    return np.asarray(mapped)


def check_camera(
    camera: Intrinsics, file: str | Path, depth: np.ndarray, shape: tuple[int, int]
) -> None:
    """Check that a depth image, an image of some shape (H, W) and intrinsics belong together.

    Raises:
        InputError: they do not.
    """
    said = f"{depth.shape[1]} x {depth.shape[0]}"
    if depth.shape != shape:
        message = f"has {said} pixels, but the image {shape[1]} x {shape[0]}: register it first"
        raise InputError("--depth", "", message)
    if camera.shape is not None and camera.shape != depth.shape:
        theirs = f"{camera.shape[1]} x {camera.shape[0]}"
        raise InputError(file, "width, height", f"are {theirs}, but the depth image is {said}")
    (cx, cy), (height, width) = camera.centre, depth.shape
    if not (0 < cx < width and 0 < cy < height):
        message = f"{cx:g}, {cy:g} is not in the depth image of {said} pixels: of another camera?"
        raise InputError(file, "cx, cy", message)
    if min(camera.focal) < 0.1 * max(depth.shape):
        message = f"{min(camera.focal):g} pixels is too short for {said} pixels: is it in metres?"
        raise InputError(file, "fx, fy", message)


def standing_in(depth: np.ndarray, box: Box, limits: DepthLimits, file: str | Path) -> np.ndarray:
    """What stands out (H, W) of the plane through the border of a box of a depth image.

    A plane's inverse distance is linear in the pixel.

    Raises:
        InputError: too little of the border has depth, or nothing stands out.
    """
    left, top, right, bottom = box
    part = depth[top:bottom, left:right]
    rows, columns = np.indices(part.shape)
    border = np.ones(part.shape, dtype=bool)
    border[BORDER_PX:-BORDER_PX, BORDER_PX:-BORDER_PX] = False
    used = border & np.isfinite(part)
    design = np.stack([columns, rows, np.ones_like(rows)], axis=-1).astype(float)
    ground_m = np.full(part.shape, np.nan)
    for _ in range(ROUNDS):
        if used.sum() < limits.max_holes * border.sum():
            break
        plane, *_ = np.linalg.lstsq(design[used], 1 / part[used], rcond=None)
        ground_m = 1 / np.maximum(design @ plane, 1e-9)
        off_m = np.where(border, np.abs(part - ground_m), np.nan)
        used = off_m <= max(limits.rise_m, float(np.nanmedian(off_m)))
    found = np.zeros(depth.shape, dtype=bool)
    found[top:bottom, left:right] = part < ground_m - limits.rise_m
    if not found.any():
        message = "nothing stands out of a plane in the box: name the object with --mask"
        raise InputError(file, "", message)
    return found


def longest_extent(
    depth: np.ndarray, region: np.ndarray, camera: Intrinsics, limits: DepthLimits, file: str | Path
) -> float:
    """The longest extent in metres of what a region (H, W) bool of a depth image shows.

    It is the longer side of the smallest rectangle around the points in their own plane. Only the
    longest one: what is behind the visible side has unknown extents.

    Raises:
        InputError: the region has too many holes, or is too near or far.
    """
    import trimesh  # takes half a second, and photographs without depth need none of it

    seen = region & np.isfinite(depth)
    holes = 1 - seen.sum() / max(region.sum(), 1)
    if holes > limits.max_holes:
        message = f"has no depth for {holes:.0%} of the object; at most {limits.max_holes:.0%}"
        raise InputError(file, "", message)
    low, high = limits.range_m
    middle_m = float(np.median(depth[seen]))
    if not low <= middle_m <= high:
        message = f"the object is {middle_m:.4g} m away; must be {low:g} to {high:g} m; {UNITS}"
        raise InputError(file, "", message)
    near, far = np.quantile(depth[seen], [limits.outliers, 1 - limits.outliers])
    rows, columns = np.nonzero(seen & (depth >= near) & (depth <= far))
    z = depth[rows, columns]
    x, y = (
        (k - c) * z / f
        for k, c, f in zip((columns, rows), camera.centre, camera.focal, strict=True)
    )
    points = np.stack([x, y, z], axis=1)
    *_, axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    with parsing(file, "shows too little of the object to measure it"):
        _, sides_m = trimesh.bounds.oriented_bounds_2D(points @ axes[:2].T)
    return float(max(sides_m))
