"""What a user adds: a third task for known objects, and a mesh with a measured contact map."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import trimesh
from repository import Repository

from grasptypes.contact_maps.affinities import COLUMNS

TASKS = {"use": 10, "handoff": -10, "wash": -20}
NAMES = ["banana", "mug", "water_bottle"]
TUBE = "tube"
RADIUS_MM, LENGTH_MM = 25.0, 220.0
# Where the tube is warm, from its middle along its axis.
WARM_MM = (20.0, 100.0)


def add_own_things(repository: Repository, **changes: object) -> None:
    """Four objects, one of them own, and three tasks, laid over the small configuration."""
    write_tube(repository.path / "meshes")
    own = {
        "file": "meshes/tube.stl",
        "unit": "mm",
        "mass_kg": 0.15,
        "contact_maps": {"use": "meshes/tube_use.ply"},
    }
    values = {
        "tasks": {task: {"colour_shift": shift} for task, shift in TASKS.items()},
        "objects.names": NAMES,
        "objects.own": {TUBE: own},
        **changes,
    }
    for key, value in values.items():
        repository.set_param(key, value)
    add_rows(repository.path / "assets/affinities.csv")


def add_rows(table: Path) -> None:
    """How people hold the objects to wash them, and the tube for what no map was measured."""
    held = {"banana": ("*", ""), "mug": ("wall", "z"), "water_bottle": ("label", "z")}
    rows = [
        (name, "wash", part, "wrap", "around", axis, 0.4, 0.6, 1, "test")
        for name, (part, axis) in held.items()
    ]
    rows += [
        (TUBE, task, "*", "wrap", "around", "z", 0.3, 0.7, 1, "test")
        for task in ("handoff", "wash")
    ]
    with table.open("a", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    assert len(rows[0]) == len(COLUMNS)


def write_tube(folder: Path) -> None:
    """A mesh, and a scan of it as ContactDB publishes them: warm all around one half."""
    folder.mkdir()
    coarse = trimesh.creation.cylinder(RADIUS_MM, LENGTH_MM, sections=48)
    coarse.export(folder / "tube.stl")
    fine = trimesh.remesh.subdivide_to_size(coarse.vertices, coarse.faces, 4.0)
    scan = trimesh.Trimesh(*fine, process=False)
    low, high = WARM_MM
    warm = (scan.vertices[:, 2] > low) & (scan.vertices[:, 2] < high)
    red = np.where(warm, 250, 20)
    scan.visual.vertex_colors = np.column_stack([red, 0 * red, 0 * red]).astype(np.uint8)
    scan.export(folder / "tube_use.ply", vertex_normal=True)
