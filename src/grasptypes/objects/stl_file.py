"""Triangles of an STL, in binary or as text."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.objects.obj_file import decoded
from grasptypes.objects.polygons import PolygonMesh

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_SOLID = re.compile(r"^[ \t]*(end)?solid\b.*$", re.IGNORECASE | re.MULTILINE)
_LOOP = re.compile(r"\bouter\s+loop\b(.*?)\bendloop\b", re.IGNORECASE | re.DOTALL)


def read_stl(path: Path) -> list[PolygonMesh]:
    """Read all solids; words may be in capitals.

    Raises:
        InputError: the file is truncated, or no STL.
    """
    content = path.read_bytes()
    faces = int.from_bytes(content[80:84], "little")
    # Binary files may begin with "solid", too.
    if len(content) == 84 + 50 * faces:
        points = np.frombuffer(content, _RECORD, faces, offset=84)["corners"].reshape(-1, 3)
        return [_mesh(points, [3] * faces)]
    text = decoded(content).replace("\0", "").replace("\r", "\n")
    text = re.sub(r"(?i)\bend[ \t]+(?=(solid|facet|loop)\b)", "end", text)
    solids = [*_SOLID.finditer(text)]
    if not solids or not solids[-1][1]:
        raise InputError(
            path, "", "is not a complete STL: it is truncated, or another kind of file"
        )
    facets = [_read_facets(path, part) for part in _SOLID.sub("\0", text).split("\0")]
    return [mesh for mesh in facets if len(mesh.sizes)]


def _read_facets(path: Path, text: str) -> PolygonMesh:
    """Read the text between lines that begin or end solids."""
    loops = _LOOP.findall(text)
    for word in ("facet", "endfacet", "loop", "endloop"):
        count = len(re.findall(rf"\b{word}\b", text, re.IGNORECASE))
        if count != len(loops):
            message = f"is there {count} times, but {len(loops)} faces are complete: damaged file"
            raise InputError(path, word, message)
    points: list[tuple[float, float, float]] = []
    sizes = []
    for loop in loops:
        before, *rows = re.split(r"\bvertex\b", loop, flags=re.IGNORECASE)
        try:
            points += [(float(x), float(y), float(z)) for x, y, z in map(str.split, rows)]
        except ValueError as error:
            message = f"'{' '.join(loop.split())}' needs three numbers each"
            raise InputError(path, "vertex", message) from error
        if before.strip() or len(rows) < 3:
            message = f"'{' '.join(loop.split())}' needs three vertices"
            raise InputError(path, "outer loop", message)
        sizes.append(len(rows))
    return _mesh(points, sizes)


def _mesh(points: object, sizes: list[int]) -> PolygonMesh:
    """Faces that share no vertices."""
    vertices: NDArray[np.float64] = np.array(points, dtype=np.float64).reshape(-1, 3)
    return PolygonMesh(vertices, np.arange(len(vertices)), np.array(sizes, dtype=np.int64))
