"""Small solids with faces of many corners, as text and bytes of mesh files."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

Faces = Sequence[Sequence[int]] | np.ndarray


@dataclass(frozen=True)
class Prism:
    """A plane outline, which may be concave and have holes, carried upwards.

    Attributes:
        vertices: (2 N, 3), the lower outline first, in metres.
        faces: both caps, then the sides.
        area_m2: what the surface measures.
        volume_m3: what the solid measures.
    """

    vertices: np.ndarray
    faces: list[list[int]]
    area_m2: float
    volume_m3: float


def prism(outlines: Sequence[np.ndarray], cap: Iterable[int], height_m: float = 0.03) -> Prism:
    """Carry outlines upwards: the first counter-clockwise, holes clockwise.

    Args:
        cap: corners of the upper cap, joined to the holes by double edges.
    """
    points = np.concatenate(outlines)
    count, start, base, length = len(points), 0, 0.0, 0.0
    sides: list[list[int]] = []
    for outline in outlines:
        after = np.roll(outline, -1, axis=0)
        base += float((outline[:, 0] * after[:, 1] - outline[:, 1] * after[:, 0]).sum()) / 2
        length += float(np.linalg.norm(after - outline, axis=1).sum())
        ring = list(range(start, start + len(outline)))
        start += len(outline)
        for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
            sides.append([a, b, b + count, a + count])
    lower, upper = np.zeros((count, 1)), np.full((count, 1), height_m)
    vertices = np.vstack([np.hstack([points, lower]), np.hstack([points, upper])])
    corners = list(cap)
    faces = [[k + count for k in corners], corners[::-1], *sides]
    return Prism(vertices, faces, 2 * base + length * height_m, base * height_m)


def square(half_m: float) -> np.ndarray:
    """A square, counter-clockwise."""
    return half_m * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=float)


U = 0.01 * np.array([(0, 0), (6, 0), (6, 5), (4, 5), (4, 2), (2, 2), (2, 5), (0, 5)])
BRACKET = prism([U], range(8))
# The same with a corner in the middle of every edge.
FINER = np.stack([U, (U + np.roll(U, -1, axis=0)) / 2], axis=1).reshape(-1, 2)
COLLINEAR = prism([FINER], range(16))
# The hole's corners run clockwise; the outline goes to it from corner 0 and comes back there.
RING = prism([square(0.03), square(0.01)[::-1]], [0, 1, 2, 3, 0, 7, 4, 5, 6, 7])


def triangles() -> list[list[int]]:
    """The bracket's faces as triangles."""
    pieces = [[0, 1, 4, 5], [1, 2, 3, 4], [0, 5, 6, 7]]
    caps = [[k + 8 for k in piece] for piece in pieces] + [piece[::-1] for piece in pieces]
    return [[f[0], f[k], f[k + 1]] for f in [*caps, *BRACKET.faces[2:]] for k in (1, 2)]


def obj(vertices: np.ndarray, faces: Faces, relative: bool = False, sep: str = " ") -> str:
    """A Wavefront OBJ."""
    shift = -len(vertices) if relative else 1
    rows = [["v", *map(repr, vertex)] for vertex in vertices.tolist()]
    rows += [["f", *(str(k + shift) for k in face)] for face in faces]
    return "".join(sep.join(row) + "\n" for row in rows)


def ply(vertices: np.ndarray, faces: Faces, order: str = "", size: str = "uchar") -> bytes:
    """A PLY as text, or in binary with a byte order (< or >)."""
    kind = {"": "ascii", "<": "binary_little_endian", ">": "binary_big_endian"}[order]
    head = (
        f"ply\nformat {kind} 1.0\ncomment made here\nelement vertex {len(vertices)}\n"
        "property double x\nproperty double y\nproperty double z\nproperty uchar quality\n"
        f"element face {len(faces)}\nproperty list {size} int vertex_indices\nend_header\n"
    )
    if not order:
        rows = [[*vertex, 7] for vertex in vertices.tolist()] + [[len(f), *f] for f in faces]
        return (head + "".join(" ".join(map(str, row)) + "\n" for row in rows)).encode()
    letter = {"uchar": "B", "int": "i"}[size]
    body = b"".join(struct.pack(f"{order}3dB", *v, 7) for v in vertices.tolist())
    body += b"".join(struct.pack(f"{order}{letter}{len(f)}i", len(f), *f) for f in faces)
    return head.encode() + body


def strips_ply(strips: Sequence[Sequence[int]], faces: Faces = (), order: str = "") -> bytes:
    """The bracket as a PLY with one row of strips that -1 separates, beside its faces."""
    row = [k for strip in strips for k in (*strip, -1)][:-1]
    whole = ply(BRACKET.vertices, faces, order)
    head, mark, body = whole.partition(b"end_header\n")
    head += b"element tristrips 1\nproperty list int int vertex_indices\n"
    numbers = [len(row), *row]
    text = " ".join(map(str, numbers)).encode() + b"\n"
    return (
        head + mark + body + (struct.pack(f"{order}{len(numbers)}i", *numbers) if order else text)
    )


def stl(vertices: np.ndarray, faces: Faces, name: str = " part") -> str:
    """An STL as text."""
    lines = [f"solid{name}"]
    for face in faces:
        lines += ["  facet normal 0 0 0", "    outer loop"]
        lines += [f"      vertex {x!r} {y!r} {z!r}" for x, y, z in vertices[face].tolist()]
        lines += ["    endloop", "  endfacet"]
    return "\n".join([*lines, f"endsolid{name}"]) + "\n"


def binary_stl(vertices: np.ndarray, faces: Faces) -> bytes:
    """A binary STL whose header begins as text does."""
    rows = [struct.pack("<12fH", 0, 0, 0, *vertices[f].ravel(), 0) for f in faces]
    return b"solid".ljust(80) + struct.pack("<I", len(faces)) + b"".join(rows)


def glb(
    positions: np.ndarray,
    primitives: Sequence[np.ndarray],
    node: dict[str, object] | None = None,
    normalized: bool = False,
    mode: int = 4,
    **header: object,
) -> bytes:
    """A GLB with one mesh.

    Args:
        positions: (V, 3) of any type that glTF allows; rows of integers are padded to 4 bytes.
        primitives: indices of each piece.
        node: further properties of the node.
        header: further entries of the JSON.
    """
    columns = 3 if positions.dtype.kind == "f" else 4
    rows = np.zeros((len(positions), columns), positions.dtype)
    rows[:, :3] = positions
    blocks = [rows.tobytes(), *(piece.astype("<u4").tobytes() for piece in primitives)]
    starts = np.cumsum([0] + [len(block) for block in blocks]).tolist()
    code = {"f4": 5126, "i2": 5122, "u2": 5123, "i1": 5120, "u1": 5121}[positions.dtype.str[1:]]
    tree = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "thing", **(node or {})}],
        "materials": [{} for _ in primitives],
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0}, "indices": 1 + k, "material": k, "mode": mode}
            for k in range(len(primitives))
        ]}],
        "accessors": [
            {"bufferView": 0, "componentType": code, "count": len(positions), "type": "VEC3",
             "normalized": normalized},
            *({"bufferView": 1 + k, "componentType": 5125, "count": piece.size, "type": "SCALAR"}
              for k, piece in enumerate(primitives)),
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": len(block),
             **({} if k else {"byteStride": columns * positions.itemsize})}
            for k, (start, block) in enumerate(zip(starts, blocks, strict=False))
        ],
        "buffers": [{"byteLength": starts[-1]}],
        **header,
    }  # fmt: skip
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", starts[-1], b"BIN\0") + b"".join(blocks)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
