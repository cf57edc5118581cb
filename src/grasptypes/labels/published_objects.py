"""The objects of the published poses: reference scans, or our own models in their frame."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import trimesh

from grasptypes.labels.contacts import MeshDistance
from grasptypes.labels.replay import read_reference_mesh
from grasptypes.objects.object_files import SURFACE, read_surface
from grasptypes.settings.grasp_types import ModelFrame


def object_distances(
    names: list[str],
    references: str | Path,
    own: str | Path,
    scale: float,
    own_frames: Mapping[str, ModelFrame],
) -> dict[str, MeshDistance]:
    """Distances to the objects, in the frame of the published poses.

    Args:
        names: requested objects; those without any mesh are skipped.
        references: folder of `<object>.stl`.
        own: folder of `<object>/surface.npz`, prepared objects at scale.
        scale: scale of the reference meshes.
        own_frames: placement of our own models of some objects in that frame.

    Raises:
        InputError: a mesh cannot be read.
    """
    distances = {}
    for name in names:
        reference, prepared = Path(references) / f"{name}.stl", Path(own) / name / SURFACE
        if reference.exists():
            mesh = read_reference_mesh(reference, scale)
        elif prepared.exists():
            mesh = own_mesh(prepared, own_frames.get(name))
        else:
            continue
        vertices = np.ascontiguousarray(mesh.vertices, dtype=np.float64)
        distances[name] = MeshDistance(vertices, np.ascontiguousarray(mesh.faces, dtype=np.int64))
    return distances


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
