"""Measured contact maps of a user's object: ContactDB's thermal scans and similar files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.objects.ply_file import Element, has_texture, ply_points, read_ply


@dataclass(frozen=True)
class ContactScan:
    """How warm a hand left the points of an object.

    Attributes:
        points_m: (N, 3), object frame, at the size of the file.
        intensity: (N,) 0 to 1, NaN where the camera saw nothing.
    """

    points_m: NDArray[np.float64]
    intensity: NDArray[np.float64]


def read_contact_scan(path: str | Path, metres: float = 1.0) -> ContactScan:
    """Read a PLY with vertex colours, as published by ContactDB.

    The red channel is the thermal intensity and 0 means unseen (ContactDB, Brahmbhatt et al.
    2019: `<object>_textured.ply`).

    Args:
        metres: length of the file's unit.

    Raises:
        InputError: no vertex colours (for example a texture instead), or nothing was seen.
    """
    path = Path(path)
    if path.suffix.lower() != ".ply":
        raise InputError(path, "", "is not a contact map: a PLY with vertex colours is needed")
    if not path.is_file():
        raise InputError(path, "", "no such file")
    elements = read_ply(path)
    points_m = ply_points(path, elements) * metres
    red = _red_channel(path, elements)
    if not np.isfinite(points_m).all():
        raise InputError(path, "", "some vertices are not finite (NaN or infinite)")
    if not (red > 0).any():
        raise InputError(path, "red", "is 0 at every vertex, so nothing was seen")
    return ContactScan(points_m, np.where(red > 0, red / 255.0, np.nan))


def _red_channel(path: Path, elements: Mapping[str, Element]) -> NDArray[np.float64]:
    """Return the red channel (V,), 0 to 255."""
    vertex = elements["vertex"]
    if not {"red", "green", "blue"} <= set(vertex.columns):
        if has_texture(elements):
            raise InputError(path, "", "has a texture, but vertex colours are needed")
        raise InputError(path, "", "has no vertex colours: the red channel is the contact map")
    red, most = vertex.columns["red"], 1 if vertex.types["red"] in "fd" else 255
    if not ((red >= 0) & (red <= most)).all():
        bad = int(np.argmin((red >= 0) & (red <= most)))
        raise InputError(path, "red", f"is {red[bad]:g} at vertex {bad}; must be 0 to {most}")
    return np.asarray(red * 255 / most)
