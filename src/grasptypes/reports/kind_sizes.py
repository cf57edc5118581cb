"""Sizes and masses of real objects beside the ranges of their kinds."""

from __future__ import annotations

import json
import re
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh
from numpy.typing import NDArray

from grasptypes.errors import InputError, parsing
from grasptypes.kinds.library import read_kind
from grasptypes.kinds.modelling import Draw, build_kind
from grasptypes.kinds.names import DATA, kind_names
from grasptypes.objects import solids

YCB, FURNITURE = "GRASPTYPES_YCB", "GRASPTYPES_FURNITURE"
MASSES = "scripts/ycb_mass.json"
SIDES = ("longest", "middle", "shortest")
Array = NDArray[np.float64]

SIZE_TABLE = pa.DataFrameSchema(
    {
        "kind": pa.Column(str),
        "object": pa.Column(str),
        **{
            f"{side}{what}_mm": pa.Column(float) for side in SIDES for what in ("", "_low", "_high")
        },
        **{f"mass{what}_g": pa.Column(float, nullable=True) for what in ("", "_low", "_high")},
        "inside": pa.Column(bool, description="whether all values are within their ranges"),
    },
    strict=True,
    ordered=True,
    unique=["kind", "object"],
)


class RealObject(NamedTuple):
    """An object that was measured.

    Attributes:
        name: with the set that it belongs to.
        sides_m: (3,) of its smallest box, descending.
        mass_kg: None if it is unknown.
    """

    name: str
    sides_m: Array
    mass_kg: float | None


def ycb_objects(folder: Path) -> dict[str, RealObject]:
    """The YCB objects in a checkout of elpis-lab/YCB_Dataset, by name.

    Raises:
        InputError: it is no such checkout.
    """
    with parsing(folder / MASSES, f"cannot be read; {YCB} must name a YCB_Dataset checkout"):
        masses = json.loads((folder / MASSES).read_text(encoding="utf-8"))
    found = {}
    for path in sorted(folder.glob("ycb/*/textured.obj")):
        name = path.parent.name
        lines = path.read_text(encoding="utf-8").splitlines()
        points = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)
        sides_m = np.sort(trimesh.bounds.oriented_bounds(points)[1])[::-1]
        found[name] = RealObject(f"YCB {name}", sides_m, masses.get(name))
    return found


def furniture_objects(folder: Path) -> dict[str, RealObject]:
    """The items of Sweet Home 3D's furniture libraries (.sh3f) in a folder, by name.

    Of items with the same name, the first one counts.

    Raises:
        InputError: there are none.
    """
    found: dict[str, RealObject] = {}
    for path in sorted(folder.glob("*.sh3f")):
        with zipfile.ZipFile(path) as library:
            catalogue = next(n for n in library.namelist() if n.endswith("Catalog.properties"))
            text = library.read(catalogue).decode("latin-1")
        items: dict[str, dict[str, str]] = {}
        for key, item, value in re.findall(r"^(\w+)#(\d+)=(.*)$", text, re.MULTILINE):
            items.setdefault(item, {})[key] = value.strip()
        for item in items.values():
            sides = [float(item.get(side, "nan")) / 100 for side in ("width", "depth", "height")]
            if np.isfinite(sides).all():
                name = item["name"]
                sides_m = np.sort(np.array(sides))[::-1]
                found.setdefault(name, RealObject(f"furniture {name}", sides_m, None))
    if not found:
        raise InputError(FURNITURE, "", f"names '{folder}', which has no .sh3f libraries")
    return found


def side_ranges(kind: str, folder: Path = DATA) -> Array:
    """Sides (2, 3) of the boxes of a kind's smallest and largest shape, descending, metres."""
    rows = []
    for share in (0.0, 1.0):
        model = build_kind(kind, Draw.extreme(read_kind(kind, folder), share), folder).model
        points = np.concatenate([solids.to_mesh(part.solid)[0] for part in model.parts])
        rows.append(np.sort(trimesh.bounds.oriented_bounds(points)[1])[::-1])
    return np.sort(np.array(rows), axis=0)


def size_table(
    ycb: Mapping[str, RealObject], furniture: Mapping[str, RealObject], folder: Path = DATA
) -> pd.DataFrame:
    """A `SIZE_TABLE` of all objects that kinds name.

    Raises:
        InputError: a kind names an object that a set lacks.
    """
    return pd.DataFrame(list(_rows(ycb, furniture, folder)))[list(SIZE_TABLE.columns)]


def _rows(
    ycb: Mapping[str, RealObject], furniture: Mapping[str, RealObject], folder: Path
) -> Iterator[dict[str, object]]:
    for name, group in kind_names(folder).items():
        kind = read_kind(name, folder)
        named = [(known, each) for known, names in ((ycb, kind.ycb), (furniture, kind.furniture))
                 for each in names]  # fmt: skip
        ranges = side_ranges(name, folder) if named else np.empty((2, 3))
        for known, each in named:
            if each not in known:
                raise InputError(folder / f"{group}.yaml", name, f"there is no object '{each}'")
            yield _row(name, known[each], ranges, (kind.mass_kg.low, kind.mass_kg.high))


def _row(
    kind: str, real: RealObject, ranges: Array, masses: tuple[float, float]
) -> dict[str, object]:
    # To the millimetre and gram, which is as well as the objects were measured.
    low, high, sides = (1e3 * np.round(each, 3) for each in (*ranges, real.sides_m))
    inside = bool(((low <= sides) & (sides <= high)).all())
    if real.mass_kg is not None:
        inside = inside and masses[0] <= real.mass_kg <= masses[1]
    row: dict[str, object] = {"kind": kind, "object": real.name, "inside": inside}
    for number, side in enumerate(SIDES):
        row |= {f"{side}_mm": sides[number], f"{side}_low_mm": low[number]}
        row[f"{side}_high_mm"] = high[number]
    row["mass_g"] = None if real.mass_kg is None else 1e3 * real.mass_kg
    return row | {"mass_low_g": 1e3 * masses[0], "mass_high_g": 1e3 * masses[1]}
