"""Contact sheets of kinds: every shape from the side that shows most."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from grasptypes.kinds.modelling import build_shape
from grasptypes.kinds.names import DATA, shape_names
from grasptypes.objects.parts import ImportedModel
from grasptypes.objects.preparation import visual_glb
from grasptypes.renders.contact_pictures import look_at
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import load_parts
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.settings.kinds import KindSheetSettings


def kind_sheet(
    kinds: Sequence[str],
    camera: Camera,
    settings: KindSheetSettings,
    crease_deg: float,
    folder: Path = DATA,
) -> NDArray[np.uint8]:
    """The shapes of each kind side by side, (H, W, 3)."""
    tiles = []
    for kind in kinds:
        pictures = [
            shape_picture(name, camera, settings, crease_deg, folder)
            for name in shape_names(kind, settings.shapes)
        ]
        tiles.append(Tile(np.hstack(pictures), kind.replace("_", " ")))
    return sheet([Group("", tiles)], settings.columns, settings.tile_px)


def shape_picture(
    name: str, camera: Camera, settings: KindSheetSettings, crease_deg: float, folder: Path
) -> NDArray[np.uint8]:
    """One shape from diagonally above, (size, size, 3)."""
    model = build_shape(name, folder).model
    with tempfile.NamedTemporaryFile(suffix=".glb") as file:
        file.write(visual_glb(ImportedModel(model, 1.0), crease_deg))
        file.flush()
        parts = load_parts(file.name)
    scene, node, _ = camera.scene(parts)
    points = np.concatenate([part.vertices for part in parts])
    pose = look_at(points, settings.azimuth_rad, settings.elevation_rad, camera.settings)
    scene.set_pose(node, pose)
    return camera.compose(camera.shoot(scene), points, pose)
