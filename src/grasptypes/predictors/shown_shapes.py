"""What a user shows as a mesh, as points or as an object: drawn as the predictors have learned."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from grasptypes.errors import InputError
from grasptypes.objects import point_clouds
from grasptypes.objects.loading import own_object
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.predictors.shown import Shown
from grasptypes.renders.mesh_views import mesh_views, views
from grasptypes.settings.params import Params

_DRAWING = threading.Lock()


@contextmanager
def _drawing() -> Iterator[None]:
    """One thread draws at a time, and torch is loaded before OpenGL: see `renders.renderer`."""
    import_module("torchvision")
    with _DRAWING:
        yield


def look_at_object(geometry: ObjectGeometry, params: Params) -> Shown:
    """See a prepared object from random sides."""
    size_m = np.sort(np.ptp(geometry.properties.bounds_m, axis=0))[::-1]
    with _drawing():
        seen = views(geometry.visual, params.renders, params.predict.views)
    return Shown(tuple(seen), tuple(size_m.tolist()))


def look_at_file(path: Path, unit: str, params: Params) -> Shown:
    """See what a file of a mesh or of points shows.

    Raises:
        InputError: the file cannot be used.
    """
    if point_clouds.is_cloud(path):
        return _cloud(path, unit, params)
    return _mesh(path, unit, params)


def _mesh(path: Path, unit: str, params: Params) -> Shown:
    with _drawing():
        seen, size_m = mesh_views(own_object(path, unit), params)
    return Shown(tuple(seen), tuple(sorted(size_m, reverse=True)))


def _cloud(path: Path, unit: str, params: Params) -> Shown:
    """Points are drawn as the surface of balls around them; their own extents are the size."""
    points = point_clouds.read_cloud(path, unit, params.predict.clouds)
    size_m = point_clouds.extents(points)
    low, high = params.predict.size_m
    if not low <= size_m[0] <= high:
        message = (
            f"the points extend over {size_m[0]:.4g} m; must be {low:g} to {high:g} m (--unit)"
        )
        raise InputError(path, "", message)
    with TemporaryDirectory() as folder:
        surface = Path(folder) / "points.stl"
        point_clouds.wrapped(points, params.predict.clouds).export(surface)
        shown = _mesh(surface, "m", params)
    text = "the points are drawn as a surface around them; what they do not cover is not seen"
    return replace(shown, size_m=size_m, warnings=(text,))
