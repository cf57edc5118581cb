"""Faces of a Wavefront OBJ, whatever groups, objects and materials they belong to."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from grasptypes.errors import InputError
from grasptypes.objects.polygons import PolygonMesh


def read_obj(path: Path) -> PolygonMesh:
    """Read vertices and faces; indices may be relative, and faces may stand between vertices.

    Raises:
        InputError: names the line that cannot be read.
    """
    vertices: list[list[float]] = []
    corners: list[int] = []
    sizes: list[int] = []
    for line, (kind, *words) in _statements(decoded(path.read_bytes())):
        try:
            if kind == "v":
                vertices.append([float(words[0]), float(words[1]), float(words[2])])
            elif kind == "f":
                indices = [int(word.split("/", 1)[0]) for word in words]
                corners += [i - 1 if i > 0 else len(vertices) + i for i in indices]
                sizes.append(len(indices))
                if len(indices) < 3 or 0 in indices or min(corners[-len(indices) :]) < 0:
                    raise IndexError
        except (ValueError, IndexError) as error:
            text = " ".join([kind, *words])[:60]
            wanted = "three numbers" if kind == "v" else "three or more vertices of the file"
            raise InputError(path, f"line {line}", f"'{text}' needs {wanted}") from error
    return PolygonMesh(
        np.array(vertices, dtype=np.float64).reshape(-1, 3),
        np.array(corners, dtype=np.int64),
        np.array(sizes, dtype=np.int64),
    )


def decoded(content: bytes) -> str:
    """The text of a mesh file; bytes of other encodings, as in names, do not matter."""
    for mark, encoding in (
        (codecs.BOM_UTF8, "utf-8-sig"),
        (codecs.BOM_UTF16_LE, "utf-16"),
        (codecs.BOM_UTF16_BE, "utf-16"),
    ):
        if content.startswith(mark):
            return content.decode(encoding, errors="replace")
    return content.decode("ascii", errors="replace")


def _statements(text: str) -> Iterator[tuple[int, list[str]]]:
    """Line number and words of every statement; comments are dropped, long lines joined."""
    started: list[str] = []
    lines = re.split(r"\r\n|\n|\r", text)
    for number, line in enumerate(lines, start=1):
        content = line.partition("#")[0].rstrip()
        started += content.removesuffix("\\").split()
        if started and (not content.endswith("\\") or number == len(lines)):
            yield number, [started[0].lower(), *started[1:]]
            started = []
