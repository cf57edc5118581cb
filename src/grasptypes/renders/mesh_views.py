"""Renders of a user's mesh, made in the same way as the training images."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from grasptypes.objects.mesh_import import ImportLimits, import_model
from grasptypes.objects.preparation import scaled_parts, visual_glb
from grasptypes.renders.renderer import Camera, Studio
from grasptypes.renders.scene import load_parts


def mesh_views(
    own: Mapping[str, Any],
    objects: Mapping[str, Any],
    renders: Mapping[str, Any],
    count: int,
    key: str,
) -> np.ndarray:
    """Views (count, S, S, 3) uint8 of a mesh from random sides, determined by `key`.

    Args:
        own: a block `objects.own.<name>`; mass and density have no effect.
        objects, renders: those sections of params.yaml.

    Raises:
        InputError: the mesh cannot be used.
    """
    found = import_model(own, ImportLimits(**objects["import"]))
    glb = visual_glb(scaled_parts(found.model, found.scale), objects["resolution"]["crease_deg"])
    with tempfile.TemporaryDirectory() as folder:
        visual = Path(folder) / "visual.glb"
        visual.write_bytes(glb)
        return views(visual, renders, count, key)


def views(visual: str | Path, renders: Mapping[str, Any], count: int, key: str) -> np.ndarray:
    """Views (count, S, S, 3) uint8 of a prepared object from random sides, determined by `key`."""
    studio = Studio(**{field.name: renders[field.name] for field in fields(Studio)})
    with Camera(studio) as camera:
        return np.stack(list(camera.views(load_parts(visual), count, key, 0).pictures()))
