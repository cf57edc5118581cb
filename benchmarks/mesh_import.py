"""Whether meshes as people have them can be used: reports/mesh_import.csv.

Run from the repository:

    python benchmarks/mesh_import.py

GRASPTYPES_YCB names a checkout of elpis-lab/YCB_Dataset, GRASPTYPES_FURNITURE a folder of Sweet
Home 3D's libraries, of which items up to 40 cm count. Each mesh is read, prepared and searched for
parts in a process of its own, which may use 30 seconds of a processor. Extents and, of watertight
meshes, the volume are compared with what trimesh reads.
"""

from __future__ import annotations

import multiprocessing
import os
import re
import resource
import signal
import sys
import tempfile
import zipfile
from collections.abc import Iterator, Sequence
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.errors import InputError
from grasptypes.objects.loading import load_object
from grasptypes.reports.kind_sizes import FURNITURE, YCB
from grasptypes.segmentation.known_parts import known_parts
from grasptypes.settings.params import Params, read_params
from grasptypes.tables import write_table

# On a busy machine, 30 seconds of a processor take longer.
LIMIT_S, PATIENCE_S = 30, 3600.0
LARGEST_CM = 40.0
PREPARED, HANGS, DIED = "prepared", "takes too long", "dies"
IMPORT_SCHEMA = pa.DataFrameSchema(
    {
        "set": pa.Column(str),
        "object": pa.Column(str),
        "outcome": pa.Column(str, description="prepared, or the line that says why not"),
        "repairs": pa.Column(str, description="what was mended"),
        "parts": pa.Column(float, nullable=True, description="number of parts found"),
        "seconds": pa.Column(float, nullable=True, description="of processor time"),
        "peak_mb": pa.Column(float, nullable=True, description="of the process's memory"),
        "extent_error": pa.Column(
            float,
            nullable=True,
            description="largest difference of a side, relative to the longest",
        ),
        "volume_ratio": pa.Column(
            float, nullable=True, description="to that of a watertight mesh as trimesh reads it"
        ),
    },
    strict=True,
    ordered=True,
    unique=["set", "object"],
)


class Mesh(NamedTuple):
    """A mesh and its longest side in metres; None if the file is in metres."""

    origin: str
    name: str
    path: Path
    longest_m: float | None


def ycb_meshes(folder: Path) -> Iterator[Mesh]:
    """The YCB objects, in metres."""
    for path in sorted(folder.glob("ycb/*/textured.obj")):
        yield Mesh("ycb", path.parent.name, path, None)


def furniture_meshes(folder: Path, unpacked: Path) -> Iterator[Mesh]:
    """The small items of the furniture libraries, unpacked; the catalogue states their sides."""
    for library in sorted(folder.glob("*.sh3f")):
        with zipfile.ZipFile(library) as archive:
            catalogue = next(n for n in archive.namelist() if n.endswith("Catalog.properties"))
            text = archive.read(catalogue).decode("latin-1")
            archive.extractall(unpacked / library.stem)
        items: dict[str, dict[str, str]] = {}
        for key, item, value in re.findall(r"^(\w+)#(\d+)=(.*)$", text, re.MULTILINE):
            items.setdefault(item, {})[key] = value.strip()
        for number, item in items.items():
            sides_cm = [float(item.get(side, "inf")) for side in ("width", "depth", "height")]
            path = unpacked / library.stem / item["model"].lstrip("/")
            if max(sides_cm) <= LARGEST_CM and path.suffix == ".obj":
                yield Mesh(library.stem, f"{number} {item['name']}", path, max(sides_cm) / 100)


def try_mesh(mesh: Mesh, params: Params) -> dict[str, object]:
    """The row of a mesh, from a process of its own."""
    here, there = multiprocessing.Pipe(duplex=False)
    child = multiprocessing.get_context("fork").Process(target=_work, args=(mesh, params, there))
    child.start()
    there.close()
    row: dict[str, object] = {"outcome": HANGS}
    if here.poll(PATIENCE_S):
        try:
            row = here.recv()
        except EOFError:
            child.join()
            row = {"outcome": HANGS if child.exitcode == -signal.SIGXCPU else DIED}
    child.kill()
    child.join()
    empty = dict.fromkeys(("parts", "seconds", "peak_mb", "extent_error", "volume_ratio"), np.nan)
    return {"repairs": "", **empty, **row, "set": mesh.origin, "object": mesh.name}


def _work(mesh: Mesh, params: Params, answer: Connection) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT_S, 2 * LIMIT_S))
    try:
        row = _prepared(mesh, params)
    except InputError as error:
        row = {"outcome": str(error).replace(str(mesh.path), mesh.path.name)}
    used = resource.getrusage(resource.RUSAGE_SELF)
    seconds = used.ru_utime + used.ru_stime
    answer.send(row | {"seconds": seconds, "peak_mb": used.ru_maxrss / 1024})


def _prepared(mesh: Mesh, params: Params) -> dict[str, object]:
    """What came out of a mesh that can be used."""
    seen = trimesh.load_mesh(mesh.path, process=False)
    scale = 1.0 if mesh.longest_m is None else mesh.longest_m / float(seen.extents.max())
    geometry = load_object(mesh.path, scale=scale, settings=params.objects)
    drawn = MapTask.of_object(geometry, ("mesh", "use"), 0, params.contact_maps)
    parts = known_parts(geometry, drawn.points, params.segmentation)
    low, high = np.array(geometry.properties.bounds_m)
    sides = seen.extents * scale
    merged = trimesh.Trimesh(seen.vertices, seen.faces)
    volume_m3 = merged.volume * scale**3 if merged.is_watertight else np.nan
    return {
        "outcome": PREPARED,
        "repairs": "; ".join(geometry.properties.repairs),
        "parts": float(len(parts.roles)),
        "extent_error": float(np.abs(high - low - sides).max() / sides.max()),
        "volume_ratio": geometry.properties.volume_m3 / volume_m3,
    }


def measure(meshes: Sequence[Mesh], path: str) -> None:
    """Write a table of `IMPORT_SCHEMA`, again after each mesh: all of them take an hour."""
    params, rows = read_params("params.yaml"), []
    for mesh in meshes:
        rows.append(try_mesh(mesh, params))
        sys.stderr.write(f"{mesh.origin} {mesh.name}: {rows[-1]['outcome']}\n")
        table = pd.DataFrame(rows)[list(IMPORT_SCHEMA.columns)].round(4)
        write_table(table, path, IMPORT_SCHEMA)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as unpacked:
        found: list[Mesh] = []
        if YCB in os.environ:
            found += ycb_meshes(Path(os.environ[YCB]))
        if FURNITURE in os.environ:
            found += furniture_meshes(Path(os.environ[FURNITURE]), Path(unpacked))
        if not found:
            sys.exit(f"error: {YCB} or {FURNITURE} must name a folder of meshes")
        measure(found, "reports/mesh_import.csv")
