"""Triangles of an STL, in binary or as text."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.objects.polygons import PolygonMesh
from grasptypes.objects.text_lines import decoded

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_SOLID = re.compile(r"^[ \t]*(end)?solid\b.*$", re.IGNORECASE | re.MULTILINE)


def read_stl(path: Path, remarks: list[str]) -> list[PolygonMesh]:
    """Read all solids; words may be in capitals.

    Args:
        remarks: receives that colours are ignored.

    Raises:
        InputError: the file is truncated, or no STL.
    """
    content = path.read_bytes()
    faces = int.from_bytes(content[80:84], "little")
    # Binary files may begin with "solid", too, and some programs leave a few bytes at the end.
    if faces and 0 <= len(content) - 84 - 50 * faces < 50:
        records = np.frombuffer(content, _RECORD, faces, offset=84)
        if records["attribute"].any():
            remarks.append("colours of an STL are ignored: programs disagree on their meaning")
        points = records["corners"].reshape(-1, 3)
        return [_mesh(points.astype(np.float64), [3] * faces)]
    text = decoded(content).replace("\0", "").replace("\r", "\n")
    text = re.sub(r"(?i)\bend[ \t]+(?=(solid|facet|loop)\b)", "end", text)
    solids = [*_SOLID.finditer(text)]
    if not solids or not solids[-1][1]:
        message = "is not a complete STL: it is truncated, or another kind of file"
        if b"\0" in content[84:]:
            room = (len(content) - 84) // 50
            message = f"is not a complete STL: it should have {faces} triangles, but has {room}"
        raise InputError(path, "", message)
    facets = [_read_facets(path, part) for part in _SOLID.sub("\0", text).split("\0")]
    return [mesh for mesh in facets if len(mesh.sizes)]


def _read_facets(path: Path, text: str) -> PolygonMesh:
    """Read the text between lines that begin or end solids."""
    words = text.lower().split()
    facets, begins, ends = (
        [place for place, word in enumerate(words) if word == wanted]
        for wanted in ("facet", "loop", "endloop")
    )
    if not len(facets) == len(begins) == len(ends) == words.count("endfacet"):
        message = f"{len(facets)} facets begin, but {len(ends)} are complete: the file is damaged"
        raise InputError(path, "", message)
    numbers: list[str] = []
    sizes = []
    for begin, end in zip(begins, ends, strict=True):
        corners = words[begin + 1 : end]
        if len(corners) < 12 or corners[::4] != ["vertex"] * (len(corners) // 4):
            message = f"'{' '.join(corners)}' is not three vertices of three numbers"
            raise InputError(path, "loop", message)
        del corners[::4]
        numbers += corners
        sizes.append(len(corners) // 3)
    try:
        return _mesh(np.array(numbers, dtype=np.float64).reshape(-1, 3), sizes)
    except ValueError as error:
        message = f"{str(error).rpartition(': ')[2]} is not a number"
        raise InputError(path, "vertex", message) from error


def _mesh(points: NDArray[np.float64], sizes: list[int]) -> PolygonMesh:
    """Faces that share no vertices."""
    return PolygonMesh(points, np.arange(len(points)), np.array(sizes, dtype=np.int64))
