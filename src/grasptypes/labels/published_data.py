"""The published poses with human labels: their source and their measures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import trimesh

from grasptypes.errors import InputError
from grasptypes.hands.hand import Hand
from grasptypes.labels.agreement import LabelledGrasps, measure_published
from grasptypes.labels.contacts import MeshDistance
from grasptypes.labels.label_sources import PUBLISHED, published_path
from grasptypes.labels.published import read_published
from grasptypes.labels.replay import read_reference_mesh
from grasptypes.objects.object_files import SURFACE, read_surface
from grasptypes.objects.reference_meshes import REFERENCES
from grasptypes.settings.grasp_types import GraspTypeSettings, ModelFrame

SOURCES = {
    PUBLISHED: "get GraspTypesWithTasks.csv from github.com/nikleer/GraspTypesWithTasks, or give "
    "its URL and checksum: https://...#sha256=<64 hex digits>",
    REFERENCES: "get a folder of <object>.stl from github.com/F1sh-Fang/contactdb_assets",
}


def lacking_data(environment: Mapping[str, str]) -> str:
    """Missing data among those named by environment variables, and how to get them.

    Returns:
        One line; empty if nothing is missing.
    """
    places = {PUBLISHED: published_path(environment), REFERENCES: environment.get(REFERENCES)}
    absent = [name for name, place in places.items() if not Path(place or "missing").exists()]
    return "; ".join(
        f"{name}={environment.get(name, '')} names nothing, {SOURCES[name]}" for name in absent
    )


def labelled_grasps(
    environment: Mapping[str, str],
    hand: Hand,
    own: str | Path,
    scale: float,
    settings: GraspTypeSettings,
) -> LabelledGrasps:
    """Measure all published poses that have a type, a configuration and an object.

    Args:
        environment: names the published table, by path or URL, and the folder of reference meshes.
        hand: the hand of the published poses.
        own: folder of the objects prepared here, for those without a reference mesh.
        scale: of the reference meshes.

    Raises:
        InputError: the table cannot be read or has no configuration, or a mesh cannot be read.
    """
    path = published_path(environment)
    published = read_published(path)
    if published.hand_configuration.isna().all():
        raise InputError(path, "", "has no grasp with a hand configuration")
    fields = {}
    for name in sorted(published.object.unique()):
        scan, prepared = Path(environment[REFERENCES]) / f"{name}.stl", Path(own) / name / SURFACE
        if scan.exists():
            fields[name] = MeshDistance.of(read_reference_mesh(scan, scale))
        elif prepared.exists():
            fields[name] = MeshDistance.of(own_mesh(prepared, settings.own_frames.get(name)))
    return measure_published(published, hand, fields, settings.contacts)


def own_mesh(path: str | Path, frame: ModelFrame | None) -> trimesh.Trimesh:
    """Our own model, metres, placed on the ground with its centre above the origin.

    Args:
        path: surface file.
        frame: optional `rotation` before and `shift_m` after placing it there.
    """
    surface = read_surface(path)
    vertices = surface.vertices
    if frame:
        vertices = vertices @ np.asarray(frame.rotation, dtype=np.float64).T
    lower, upper = vertices.min(axis=0), vertices.max(axis=0)
    ground = np.array([*((lower + upper) / 2.0)[:2], lower[2]])
    shift = np.asarray(frame.shift_m if frame else np.zeros(3), dtype=np.float64)
    return trimesh.Trimesh(vertices - ground + shift, surface.faces, process=False)
