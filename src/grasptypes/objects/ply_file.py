"""Elements of a PLY file (Turk 1994): vertices, faces of any size, and colours, as stated."""

from __future__ import annotations

import codecs
import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from grasptypes.errors import InputError
from grasptypes.objects.polygons import PolygonMesh
from grasptypes.objects.surface_colours import PAPER, FaceColours, Look, linear

_TYPES = {
    "char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
    "float": "f", "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
    "int32": "i", "uint32": "I", "float32": "f", "float64": "d",
}  # fmt: skip
_TEXTURE = {"s", "t", "u", "v", "texture_u", "texture_v", "texcoord"}
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass(frozen=True)
class Ragged:
    """Lists of any length: values (C,) of all rows, and the number of values (N,) of each."""

    values: NDArray[np.float64]
    sizes: NDArray[np.int64]


@dataclass(frozen=True)
class Element:
    """A kind of row and its properties.

    Attributes:
        name: e.g. vertex.
        count: number of rows that the header states.
        types: type of each property as in `struct`; for a list, after the type of its length.
        columns: (N,) values of each property that is no list; numbers in text stay as they are.
        lists: values of each property that is a list.
    """

    name: str
    count: int
    types: dict[str, str] = field(default_factory=dict)
    columns: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    lists: dict[str, Ragged] = field(default_factory=dict)

    def fill(self, name: str, values: ArrayLike, sizes: list[int]) -> None:
        """Take the values of one property."""
        array = np.array(values, dtype=np.float64)
        if len(self.types[name]) == 1:
            self.columns[name] = array
        else:
            self.lists[name] = Ragged(array, np.array(sizes, dtype=np.int64))


def read_ply(path: Path) -> dict[str, Element]:
    """Read all elements by name.

    Raises:
        InputError: the file is no PLY, or has less content than its header says.
    """
    content = path.read_bytes().removeprefix(codecs.BOM_UTF8)
    head, end, body = content.partition(b"end_header")
    lines = head.decode("ascii", errors="replace").splitlines()
    if not end or not lines or lines[0].strip().lower() != "ply":
        raise InputError(path, "", "cannot be read as PLY: it has no header")
    order, elements = _read_header(path, lines[1:])
    if order:
        # A line ends as the first one does: what follows may be a byte like a line's end.
        line_end = next(mark for mark in (b"\r\n", b"\n", b"\r") if mark in head)
        _read_binary(path, elements, body.partition(line_end)[2], order)
    else:
        _read_text(path, elements, body)
    return {element.name: element for element in elements}


def ply_faces(path: Path, elements: Mapping[str, Element], remarks: list[str]) -> PolygonMesh:
    """Faces and strips of triangles with the colours of vertices or faces.

    Args:
        remarks: receives which colours are ignored.

    Raises:
        InputError: there are no vertices, or bad faces.
    """
    faces, strips = (_vertex_lists(path, elements, name) for name in ("face", "tristrips"))
    if (faces.sizes < 3).any():
        raise InputError(path, "face", "a face has fewer than three corners")
    triangles = _strip_triangles(strips)
    corners = np.concatenate([faces.values.astype(np.int64), triangles.ravel()])
    sizes = np.concatenate([faces.sizes, np.full(len(triangles), 3)])
    colours = _face_colours(elements, corners, sizes, remarks)
    return PolygonMesh(ply_points(path, elements), corners, sizes, colours)


def has_texture(elements: Mapping[str, Element]) -> bool:
    """Whether the vertices or faces have texture coordinates."""
    names = {*elements["vertex"].columns} if "vertex" in elements else set()
    return bool(names.union(elements["face"].lists if "face" in elements else ()) & _TEXTURE)


def _face_colours(
    elements: Mapping[str, Element],
    corners: NDArray[np.int64],
    sizes: NDArray[np.int64],
    remarks: list[str],
) -> FaceColours | None:
    """The colours of the faces' corners; None if there are none."""
    of_vertices, of_faces = (_rgb(elements, name, remarks) for name in ("vertex", "face"))
    if of_vertices is not None:
        # A vertex that is missing is reported with the faces.
        tint = of_vertices[np.clip(corners, 0, max(len(of_vertices) - 1, 0))]
    elif of_faces is not None and len(of_faces) == len(sizes):
        tint = np.repeat(of_faces, sizes, axis=0)
    else:
        if has_texture(elements):
            remarks.append("the texture of a PLY is ignored: save it as colours of vertices")
        return None
    look = np.zeros(len(sizes), dtype=np.int64)
    return FaceColours((Look(PAPER),), look, tint, np.zeros((len(corners), 2)))


def _rgb(
    elements: Mapping[str, Element], name: str, remarks: list[str]
) -> NDArray[np.float64] | None:
    """Linear colours (N, 3) of an element's rows; None if there are none."""
    element = elements.get(name, Element(name, 0))
    if not {"red", "green", "blue"} <= set(element.columns):
        return None
    colours = np.column_stack([element.columns[c] for c in ("red", "green", "blue")])
    most = 1 if element.types["red"] in "fd" else np.iinfo(element.types["red"]).max
    if not ((colours >= 0) & (colours <= most)).all():
        remarks.append(f"colours of the element {name} are ignored: they must be from 0 to {most}")
        return None
    return linear(colours / most)


def _vertex_lists(path: Path, elements: Mapping[str, Element], name: str) -> Ragged:
    """The vertex indices of an element, if there is one; raises InputError for fractions."""
    lists = elements[name].lists if name in elements else {}
    none = Ragged(np.empty(0), np.empty(0, dtype=np.int64))
    found = lists.get("vertex_indices", lists.get("vertex_index", none))
    whole = found.values == np.floor(found.values)
    if not whole.all():
        message = (
            f"a face refers to vertex {found.values[~whole][0]:g}, which is not a whole number"
        )
        raise InputError(path, name, message)
    return found


def _strip_triangles(strips: Ragged) -> NDArray[np.int64]:
    """Triangles (T, 3) of strips, turned alternately; -1 begins another strip."""
    triangles = [np.empty((0, 3), dtype=np.int64)]
    for row in np.split(strips.values.astype(np.int64), np.cumsum(strips.sizes)):
        for strip in np.split(row, np.flatnonzero(row == -1)):
            corners = strip[strip != -1]
            if len(corners) >= 3:
                found = sliding_window_view(corners, 3).copy()
                found[1::2] = found[1::2, ::-1]
                triangles.append(found)
    joined = np.concatenate(triangles)
    # Strips are joined by triangles with a repeated corner.
    return np.asarray(joined[(joined != np.roll(joined, 1, axis=1)).all(axis=1)])


def ply_points(path: Path, elements: Mapping[str, Element]) -> NDArray[np.float64]:
    """Positions (V, 3) of the vertices; raises InputError if the file has none."""
    vertex = elements.get("vertex", Element("vertex", 0))
    if not {"x", "y", "z"} <= set(vertex.columns):
        raise InputError(path, "vertex", "has no x, y and z")
    return np.column_stack([vertex.columns[axis] for axis in "xyz"])


def _read_header(path: Path, lines: list[str]) -> tuple[str, list[Element]]:
    """Byte order ('' for text), and the elements without their content."""
    order = None
    elements: list[Element] = []
    for line in lines:
        words = line.split()
        try:
            if not words or words[0] in ("comment", "obj_info"):
                continue
            if words[0] == "format":
                order = _ORDERS[words[1]]
            elif words[0] == "element":
                elements.append(Element(words[1], int(words[2])))
            elif words[0] == "property" and words[1] == "list":
                elements[-1].types[words[4]] = _TYPES[words[2]] + _TYPES[words[3]]
            elif words[0] == "property":
                elements[-1].types[words[2]] = _TYPES[words[1]]
            else:
                raise ValueError
        except (KeyError, IndexError, ValueError) as error:
            message = f"'{line.strip()}' cannot be read as PLY"
            raise InputError(path, "header", message) from error
    if order is None:
        raise InputError(path, "header", "names no format")
    return order, elements


def _read_text(path: Path, elements: list[Element], body: bytes) -> None:
    """Fill the elements from lines of numbers, one line a row."""
    lines = [line.split() for line in body.splitlines() if line.strip()]
    for element in elements:
        rows, lines = lines[: element.count], lines[element.count :]
        _check_count(path, element, len(rows))
        values: dict[str, list[bytes]] = {name: [] for name in element.types}
        sizes: dict[str, list[int]] = {name: [] for name in element.types}
        for row in rows:
            try:
                at = 0
                for name, types in element.types.items():
                    size, at = (int(row[at]), at + 1) if len(types) > 1 else (1, at)
                    values[name] += row[at : at + size]
                    sizes[name].append(size)
                    at += size
            except (ValueError, IndexError):
                at = -1
            if at != len(row):
                text = b" ".join(row).decode("ascii", errors="replace")[:60]
                raise InputError(path, element.name, f"'{text}' is not what the header says")
        for name in element.types:
            try:
                element.fill(name, values[name], sizes[name])
            except ValueError as error:
                value = str(error).rpartition(": ")[2].removeprefix("b")
                raise InputError(
                    path, f"{element.name} {name}", f"{value} is not a number"
                ) from error


def _read_binary(path: Path, elements: list[Element], body: bytes, order: str) -> None:
    """Fill the elements from bytes in one order (< or >)."""
    at = 0
    for element in elements:
        if not element.types:
            continue
        if any(len(types) > 1 for types in element.types.values()):
            at = _read_lists(path, element, body, at, order)
            continue
        row = np.dtype([(name, order + kind) for name, kind in element.types.items()])
        _check_count(path, element, (len(body) - at) // row.itemsize)
        rows = np.frombuffer(body[at : at + element.count * row.itemsize], row)
        for name in element.types:
            element.fill(name, rows[name], [])
        at += element.count * row.itemsize


def _read_lists(path: Path, element: Element, body: bytes, at: int, order: str) -> int:
    """Fill an element that has lists, and return where the next one begins."""
    values: dict[str, list[float]] = {name: [] for name in element.types}
    sizes: dict[str, list[int]] = {name: [] for name in element.types}
    for row in range(element.count):
        try:
            for name, types in element.types.items():
                size = 1
                if len(types) > 1:
                    size = struct.unpack_from(order + types[0], body, at)[0]
                    at += struct.calcsize(types[0])
                values[name] += struct.unpack_from(f"{order}{size}{types[-1]}", body, at)
                sizes[name].append(size)
                at += size * struct.calcsize(types[-1])
        except struct.error:
            _check_count(path, element, row)
    for name in element.types:
        element.fill(name, values[name], sizes[name])
    return at


def _check_count(path: Path, element: Element, found: int) -> None:
    """Reject a file with less content than its header says; raises InputError."""
    if found < element.count:
        message = f"the header says {element.count}, but there are {found}: the file is truncated"
        raise InputError(path, element.name, message)
