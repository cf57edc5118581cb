"""Measured contact maps of a user's object: ContactDB's thermal scans and similar files."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray

from grasptypes.errors import InputError, parsing
from grasptypes.objects.mesh_limits import check_counts


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
    with parsing(path, "cannot be read as PLY"):
        content = _unwrapped(path.read_bytes())
        loaded: Any = trimesh.load(io.BytesIO(content), file_type="ply", process=False)
    check_counts(path, loaded)
    red = _red_channel(path, loaded)
    points_m = np.asarray(loaded.vertices, dtype=np.float64) * metres
    if not np.isfinite(points_m).all():
        raise InputError(path, "", "some vertices are not finite (NaN or infinite)")
    if not (red > 0).any():
        raise InputError(path, "red", "is 0 at every vertex, so nothing was seen")
    return ContactScan(points_m, np.where(red > 0, red / 255.0, np.nan))


def _red_channel(path: Path, loaded: Any) -> NDArray[np.float64]:
    """Return the red channel (N,), 0 to 255, of a mesh or point cloud."""
    kind = getattr(getattr(loaded, "visual", None), "kind", None)
    if kind == "texture":
        raise InputError(path, "", "has a texture, but vertex colours are needed")
    colours = loaded.visual.vertex_colors if kind == "vertex" else getattr(loaded, "colors", None)
    if colours is None or len(colours) != len(loaded.vertices):
        raise InputError(path, "", "has no vertex colours: the red channel is the contact map")
    # The numbers in the file: trimesh converts them to bytes, whatever they are.
    stated = np.ravel(loaded.metadata["_ply_raw"]["vertex"]["data"]["red"])
    red, most = stated.astype(np.float64), 1 if stated.dtype.kind == "f" else 255
    if not ((red >= 0) & (red <= most)).all():
        bad = int(np.argmin((red >= 0) & (red <= most)))
        raise InputError(path, "red", f"is {stated[bad]} at vertex {bad}; must be 0 to {most}")
    return np.asarray(red * 255 / most)


def _unwrapped(content: bytes) -> bytes:
    """A PLY whose text numbers are read unchanged: 300 in a byte would wrap to 44."""
    head, end, body = content.partition(b"end_header")
    if b"format ascii" in head:
        for kind in (b"uchar", b"uint8"):
            head = head.replace(b"property " + kind + b" ", b"property int ")
    return head + end + body
