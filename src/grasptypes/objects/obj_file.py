"""Faces and colours of a Wavefront OBJ, whatever groups and objects they belong to."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from grasptypes.errors import InputError
from grasptypes.objects.mesh_companions import library_names
from grasptypes.objects.mtl_file import find_looks
from grasptypes.objects.polygons import PolygonMesh
from grasptypes.objects.surface_colours import GREY, PAPER, FaceColours, Look, linear
from grasptypes.objects.text_lines import decoded, statements

# The material of faces before the first `usemtl`.
_NONE = ""


def read_obj(path: Path, remarks: list[str]) -> PolygonMesh:
    """Read vertices and faces; indices may be relative, and faces may stand between vertices.

    Args:
        remarks: receives which colours are missing.

    Raises:
        InputError: names the line that cannot be read.
    """
    reading = _Reading()
    for line, (kind, *words) in statements(decoded(path.read_bytes())):
        try:
            reading.take(kind, words)
        except (ValueError, IndexError) as error:
            text = " ".join([kind, *words])[:60]
            wanted = "three or more existing vertices" if kind == "f" else _NUMBERS[kind]
            raise InputError(path, f"line {line}", f"'{text}' needs {wanted}") from error
    return PolygonMesh(
        np.array(reading.vertices, dtype=np.float64).reshape(-1, 3),
        np.array(reading.corners, dtype=np.int64),
        np.array(reading.sizes, dtype=np.int64),
        reading.face_colours(path, remarks),
    )


_NUMBERS = {"v": "three numbers", "vt": "one to three numbers"}


class _Reading:
    """What the statements so far have stated."""

    def __init__(self) -> None:
        self.vertices: list[list[float]] = []
        self.corners: list[int] = []
        self.sizes: list[int] = []
        self._colours: list[list[float]] = []
        self._points: list[list[float]] = []
        self._texture_corners: list[int] = []
        self._libraries: list[str] = []
        self._materials = {_NONE: 0}
        self._look: list[int] = []
        self._material = 0

    def take(self, kind: str, words: list[str]) -> None:
        """Take one statement; raises ValueError or IndexError if it cannot be read."""
        if kind == "v":
            self.vertices.append([float(words[0]), float(words[1]), float(words[2])])
            # One number more is a weight, three are a colour.
            if len(words) >= 6:
                self._colours.append([float(word) for word in words[3:6]])
        elif kind == "vt":
            self._points.append([float(words[0]), float(words[1]) if len(words) > 1 else 0.0])
        elif kind == "f":
            self._take_face(words)
        elif kind == "usemtl":
            name = " ".join(words)
            self._material = self._materials.setdefault(name, len(self._materials))
        elif kind == "mtllib":
            self._libraries += library_names(words)

    def _take_face(self, words: list[str]) -> None:
        indices = [[int(number or 0) for number in word.split("/")[:2]] for word in words]
        corners = [_absolute(first, len(self.vertices)) for first, *_ in indices]
        if len(corners) < 3 or min(corners) < 0:
            raise IndexError
        self.corners += corners
        self.sizes.append(len(corners))
        self._look.append(self._material)
        self._texture_corners += [
            _absolute(second[0] if second else 0, len(self._points)) for _, *second in indices
        ]

    def face_colours(self, path: Path, remarks: list[str]) -> FaceColours | None:
        """The colours of all faces; None if there are none."""
        corners, names = np.array(self.corners, dtype=np.int64), list(self._materials)[1:]
        colours = np.array(self._colours).reshape(-1, 3)
        tint = np.ones((len(corners), 3))
        coloured = len(colours) == len(self.vertices) and len(colours) > 0
        if coloured and not ((colours >= 0) & (colours <= 1)).all():
            remarks.append("colours of vertices are ignored: they must be from 0 to 1")
            coloured = False
        elif len(colours) and not coloured:
            remarks.append("colours of vertices are ignored: some vertices have none")
        if coloured:
            # A vertex that is missing is reported with the faces.
            tint = linear(colours[np.minimum(corners, len(colours) - 1)])
        if not names and not coloured:
            return None
        looks = find_looks(path, self._libraries, names, remarks)
        if coloured:
            looks = [Look(PAPER) if look.material is GREY else look for look in looks]
        points = np.array([*self._points, [0.0, 0.0]])
        places = np.array(self._texture_corners, dtype=np.int64)
        uv = points[np.where(places < len(self._points), places, -1)]
        base = Look(PAPER if coloured else GREY)
        return FaceColours((base, *looks), np.array(self._look, dtype=np.int64), tint, uv)


def _absolute(index: int, count: int) -> int:
    """Index from 0 of a number from 1, or from -1 backwards; negative if there is none."""
    return index - 1 if index >= 0 else max(count + index, -1)
