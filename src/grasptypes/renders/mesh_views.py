"""Images of a user's mesh, taken as the images the predictors have learned from."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.parts import ImportedModel
from grasptypes.objects.preparation import visual_glb
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import load_parts
from grasptypes.settings.objects import OwnObject
from grasptypes.settings.params import Params
from grasptypes.settings.renders import CameraSettings

# Draws for a user's mesh depend on this word, so that its file's name does not change the answer.
MESH_WORD = "mesh"


def mesh_views(own: OwnObject, params: Params) -> tuple[np.ndarray, list[float]]:
    """Views of a mesh from random sides, and its extents; mass and density do not show.

    Returns:
        images (count, S, S, 3) uint8, and the lengths along the axes, metres.

    Raises:
        InputError: the mesh cannot be used.
    """
    found = import_model(own, params.objects.import_)
    crease_deg = params.objects.resolution.crease_deg
    with tempfile.TemporaryDirectory() as folder:
        visual = Path(folder) / "visual.glb"
        visual.write_bytes(visual_glb(found, crease_deg))
        return views(visual, params.renders, params.predict.views), _extents_m(found)


def views(visual: str | Path, settings: CameraSettings, count: int) -> np.ndarray:
    """Views (count, S, S, 3) uint8 of a prepared mesh from random sides, always the same ones."""
    with Camera(settings) as camera:
        return np.stack(list(camera.views(load_parts(visual), count, MESH_WORD, 0).pictures()))


def _extents_m(found: ImportedModel) -> list[float]:
    boxes = np.array([part.solid.bounding_box() for part in found.model.parts]).reshape(-1, 2, 3)
    extents: list[float] = (found.scale * (boxes[:, 1].max(0) - boxes[:, 0].min(0))).tolist()
    return extents
