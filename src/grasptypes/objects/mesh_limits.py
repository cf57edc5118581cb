"""Requirements on a user's mesh."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

import numpy as np
import trimesh

from grasptypes.errors import InputError
from grasptypes.objects.units import UNITS_M
from grasptypes.settings.objects import ImportLimits

Meshes = Collection[trimesh.Trimesh]


def check_file_size(path: Path, limits: ImportLimits) -> None:
    """Reject a file that is too large to read; raises InputError."""
    size_mb = path.stat().st_size / 1e6
    if size_mb > limits.max_file_mb:
        message = f"has {size_mb:.0f} MB; the limit is {limits.max_file_mb:g} MB: simplify the mesh"
        raise InputError(path, "", message)


def check_faces(path: str | Path, meshes: Meshes, limits: ImportLimits) -> None:
    """Reject meshes with too many faces; raises InputError."""
    faces = sum(len(mesh.faces) for mesh in meshes)
    if faces > limits.max_faces:
        message = f"has {faces} faces; the limit is {limits.max_faces}: simplify the mesh"
        raise InputError(path, "", message)


def check_size(
    path: str | Path, meshes: Meshes, unit: str, scale: float, limits: ImportLimits
) -> None:
    """Reject sizes that no hand can hold, and name the unit that would fit; raises InputError."""
    bounds = np.array([mesh.bounds for mesh in meshes])
    extents_m = scale * (bounds[:, 1].max(axis=0) - bounds[:, 0].min(axis=0))
    size_m = float(extents_m.max())
    if not limits.min_size_m <= size_m <= limits.max_size_m:
        fits = [
            other
            for other, factor in UNITS_M.items()
            if limits.min_size_m <= size_m / UNITS_M[unit] * factor <= limits.max_size_m
        ]
        advice = f"; unit: {' or '.join(fits)} would fit" if fits else ""
        raise InputError(
            path,
            "unit",
            f"the object would be {size_m:.4g} m long with unit {unit}, but must be "
            f"{limits.min_size_m} to {limits.max_size_m} m{advice}",
        )
    if extents_m.prod() > limits.max_box_m3:
        box = " x ".join(f"{extent:.2g}" for extent in extents_m)
        message = f"the object's bounding box is {box} m; the limit is {limits.max_box_m3:g} m3"
        raise InputError(path, "", message)


def check_volume(path: str | Path, volume_m3: float, meshes: Meshes, limits: ImportLimits) -> None:
    """Reject closed but flat meshes; raises InputError."""
    extent_m = max(float(mesh.extents.max()) for mesh in meshes)
    if volume_m3 < limits.min_volume_share * extent_m**3:
        raise InputError(path, "", "encloses no volume: it is flat")
