"""Mistakes in contact maps: measured ones that a user hands in, and the pipeline's own files."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from case import PARAMS, Case, Content, library, script

from grasptypes.contact_maps.contact_map import ContactMap, MapTask, sample_surface
from grasptypes.contact_maps.contact_map_files import read_contact_map, write_contact_map
from grasptypes.files import write_npz
from grasptypes.objects.object_files import Surface
from grasptypes.settings.contact_maps import ContactMapSettings
from grasptypes.settings.segmentation import SegmentationSettings

COARSE = trimesh.creation.cylinder(0.03, 0.1, sections=24)
ROD = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(COARSE.vertices, COARSE.faces, 0.006))
SETTINGS = ContactMapSettings.check(PARAMS["contact_maps"] | {"sessions": 1})
SEGMENTATION = SegmentationSettings.check(PARAMS["segmentation"])
SURFACE = Surface(ROD.vertices, ROD.faces, np.zeros(len(ROD.vertices), np.int16), np.array(["rod"]))
TASK = MapTask(sample_surface(SURFACE, 300, 0), ["rod"], ("rod", "use"), 0, 1.0, SETTINGS)


def measured(what: str, content: Content, *names: str, name: str = "warm.ply") -> Case:
    """A map that `objects.own.rod.contact_maps.use` names."""
    draw = script("map_contacts", "draw_map", TASK, [], name, "m", SEGMENTATION)
    return Case("contact map", what, {name: content}, draw, (name, *names))


def ply(
    red: Iterable[object] | object = 200,
    columns: str = "red green blue",
    kind: str = "uchar",
    scale: float = 1.0,
    count: int | None = None,
) -> str:
    """A PLY in text with a colour at every vertex of the rod."""
    vertices = (ROD.vertices * scale).tolist()
    reds = [red] * len(vertices) if isinstance(red, int | float | str) else list(red)  # type: ignore[arg-type]
    names = columns.split()
    head = [
        "ply", "format ascii 1.0", f"element vertex {count or len(vertices)}",
        *(f"property float {axis}" for axis in "xyz"),
        *(f"property {kind} {name}" for name in names), "end_header",
    ]  # fmt: skip
    rows = [
        " ".join(map(str, [*v, *[r] * len(names)])) for v, r in zip(vertices, reds, strict=True)
    ]
    return "\n".join([*head, *rows]) + "\n"


def spread(low: object, high: object) -> list[object]:
    """One value at the first vertex, another at the rest."""
    return [low] + [high] * (len(ROD.vertices) - 1)


def stored(what: str, change: Callable[[dict[str, Any]], dict[str, Any]], *names: str) -> Case:
    """A file of data/contact_maps that something has changed."""

    def write(path: Path) -> None:
        points, ones = np.zeros((5, 3)), np.ones(2)
        whole = ContactMap(
            points, points, np.zeros(5), np.array(["rod"]), np.ones(5), np.ones((2, 5)),
            *[np.array(["power", "power"])] * 3, *[np.zeros((2, 3))] * 3, ones, ones,
        )  # fmt: skip
        write_contact_map(whole, path)
        with np.load(path, allow_pickle=False) as arrays:
            write_npz(path, change(dict(arrays)))

    read = library(read_contact_map, "use.npz")
    return Case("contact map", what, {"use.npz": write}, read, ("use.npz", *names))


CASES = [
    measured("another format", "x", "PLY", name="warm.png"),
    measured("text named .ply", "warm\n", "cannot be read as PLY"),
    measured("truncated", ply(spread(10, 200))[:-400].rpartition("\n")[0], "vertex", "truncated"),
    measured(
        "fewer rows than the header says", ply(spread(10, 200), count=50_000), "vertex", "50000"
    ),
    measured("no colours", ply(columns=""), "no vertex colours"),
    measured("a red channel alone", ply(columns="red"), "no vertex colours"),
    measured("text instead of colours", ply(red="warm"), "vertex red", "warm"),
    measured("a byte of 300", ply(spread(300, 20)), "red: is 300 at vertex 0", "0 to 255"),
    measured("a negative number", ply(spread(-3, 20), kind="int"), "red: is -3 at vertex 0"),
    measured(
        "a share of 2", ply(spread(2.0, 0.5), kind="float"), "red: is 2 at vertex 0", "0 to 1"
    ),
    measured("NaN", ply(spread("nan", 0.5), kind="float"), "red: is nan"),
    measured("nothing seen", ply(red=0), "red", "nothing was seen"),
    measured("the same everywhere", ply(red=200), "red", "no place is warmer"),
    measured("warm at one vertex only", ply(spread(200, 1)), "red", "almost no warm vertices"),
    measured("another unit", ply(spread(200, 1), scale=1000.0), "unit and frame"),
    stored(
        "an array too short",
        lambda a: a | {"probability": a["probability"][:3]},
        "probability",
        "5 entries",
    ),
    stored(
        "sessions of other points",
        lambda a: a | {"sessions": np.ones((2, 4))},
        "sessions",
        "(2, 4)",
    ),
    stored(
        "a probability of 1.5",
        lambda a: a | {"probability": a["probability"] * 1.5},
        "probability",
        "0 to 1",
    ),
    stored(
        "a missing array",
        lambda a: {k: v for k, v in a.items() if k != "style"},
        "style",
        "missing",
    ),
    Case(
        "contact map",
        "a pickle named .npz",
        {"use.npz": b"\x80\x04\x95."},
        library(read_contact_map, "use.npz"),
        ("use.npz", "cannot be read as arrays"),
    ),
]
