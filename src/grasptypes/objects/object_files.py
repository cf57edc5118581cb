"""Reading and writing the files of a prepared object in data/objects/{object}."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_json, write_npz, write_text

VISUAL, SURFACE, COLLISION = "visual.glb", "surface.npz", "collision.obj"
DISTANCE_GRID, PROPERTIES = "distance_grid.npz", "properties.json"


@dataclass(frozen=True)
class Surface:
    """An object's surface, evenly meshed for maps with one value per vertex (object frame).

    Attributes:
        vertices: (V, 3) float64, metres.
        faces: (F, 3) int32, counter-clockwise seen from outside.
        part_index: (V,) int16 into part_names.
        part_names: (P,) strings.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int32]
    part_index: NDArray[np.int16]
    part_names: NDArray[np.str_]


@dataclass(frozen=True)
class Properties:
    """Physical properties of an object; SI units, object frame.

    Attributes:
        inertia_kg_m2: 3 rows of 3, about the centre of mass.
        density_kg_m3: of the material, or of the main one of several.
        shell_thickness_m: None if the object is solid.
        volume_m3: inside the outer surface.
        bounds_m: lowest and highest corner.
        repairs: descriptions of repairs to a user's mesh; empty for the catalogue's objects.
        roles: role and attributes of each part that has a role, by the part's name, as the fields
            of `PartRole`.
    """

    object: str
    scale: float
    mass_kg: float
    centre_of_mass_m: list[float]
    inertia_kg_m2: list[list[float]]
    density_kg_m3: float
    shell_thickness_m: float | None
    volume_m3: float
    watertight: bool
    bounds_m: list[list[float]]
    repairs: list[str]
    roles: dict[str, dict[str, Any]]


def write_surface(path: str | Path, surface: Surface) -> None:
    """Write a surface as npz with the attributes' names as keys."""
    write_npz(
        path,
        {
            "vertices": surface.vertices.astype(np.float64),
            "faces": surface.faces.astype(np.int32),
            "part_index": surface.part_index.astype(np.int16),
            "part_names": np.asarray(surface.part_names, dtype=np.str_),
        },
    )


def read_surface(path: str | Path) -> Surface:
    """Read a surface; raises InputError if an array is missing."""
    arrays = read_npz(path)
    missing = {"vertices", "faces", "part_index", "part_names"} - set(arrays)
    if missing:
        raise InputError(path, ", ".join(sorted(missing)), "missing from the surface file")
    return Surface(arrays["vertices"], arrays["faces"], arrays["part_index"], arrays["part_names"])


def write_properties(path: str | Path, properties: Properties) -> None:
    """Write the properties as JSON."""
    write_json(path, asdict(properties))


def read_properties(path: str | Path) -> Properties:
    """Read the properties; raises InputError if it is no such file."""
    try:
        properties = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(path, "", f"cannot be read as JSON: {error}") from error
    missing = {field.name for field in fields(Properties)} - set(properties)
    if missing:
        raise InputError(path, ", ".join(sorted(missing)), "missing from the properties")
    return Properties(**properties)


def write_collision(
    path: str | Path, hulls: list[tuple[NDArray[np.float64], NDArray[np.int32]]]
) -> None:
    """Write convex parts, (V, 3) vertices in metres and (F, 3) faces, one OBJ group each."""
    lines, first = [], 1
    for index, (vertices, faces) in enumerate(hulls):
        lines.append(f"o part_{index}")
        lines += [f"v {x:.7f} {y:.7f} {z:.7f}" for x, y, z in vertices]
        lines += [f"f {a} {b} {c}" for a, b, c in faces + first]
        first += len(vertices)
    write_text(path, "\n".join(lines) + "\n")


def read_collision(
    path: str | Path,
) -> list[tuple[NDArray[np.float64], NDArray[np.int32]]]:
    """Read convex parts, (V, 3) vertices in metres and (F, 3) faces, as `write_collision` wrote."""
    parts: list[tuple[NDArray[np.float64], NDArray[np.int32]]] = []
    first = 1
    for group in Path(path).read_text(encoding="utf-8").split("o part_")[1:]:
        rows = [line.split() for line in group.splitlines()[1:]]
        vertices = np.array([row[1:] for row in rows if row[0] == "v"], dtype=np.float64)
        faces = np.array([row[1:] for row in rows if row[0] == "f"], dtype=np.int32) - first
        parts.append((vertices, faces))
        first += len(vertices)
    return parts
