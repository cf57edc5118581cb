"""Images of a user's mesh, taken as the images the predictors have learned from."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.preparation import visual_glb
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import load_parts
from grasptypes.settings.objects import OwnObject
from grasptypes.settings.params import Params
from grasptypes.settings.renders import CameraSettings

# Draws for a user's mesh depend on this word, so that its file's name does not change the answer.
MESH_WORD = "mesh"


def mesh_views(own: OwnObject, params: Params) -> np.ndarray:
    """Views (count, S, S, 3) uint8 of a mesh from random sides; mass and density do not show.

    Raises:
        InputError: the mesh cannot be used.
    """
    found = import_model(own, params.objects.import_)
    crease_deg = params.objects.resolution.crease_deg
    with tempfile.TemporaryDirectory() as folder:
        visual = Path(folder) / "visual.glb"
        visual.write_bytes(visual_glb(found, crease_deg))
        return views(visual, params.renders, params.predict.views)


def views(visual: str | Path, settings: CameraSettings, count: int) -> np.ndarray:
    """Views (count, S, S, 3) uint8 of a prepared mesh from random sides, always the same ones."""
    with Camera(settings) as camera:
        return np.stack(list(camera.views(load_parts(visual), count, MESH_WORD, 0).pictures()))
