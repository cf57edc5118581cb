"""Shapes in numbers, as a point network would pool them: what answers without any image."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import trimesh

from grasptypes.predictors.general_inputs import Pictures
from grasptypes.segmentation.parts import describe_surface
from grasptypes.segmentation.samples import sample_evenly
from grasptypes.settings.segmentation import PartSettings


def describe_shapes(
    shown: Iterable[tuple[str, trimesh.Trimesh]], settings: PartSettings
) -> Pictures:
    """One row per object: mean and standard deviation of what describes the points of its surface.

    They take the place of the features of an image.

    Args:
        shown: names and meshes in metres, in any frame.
    """
    names, rows = [], []
    for name, mesh in shown:
        points_m, face = sample_evenly(mesh, settings.descriptors.points, name)
        numbers = describe_surface(points_m, mesh.face_normals[face], settings)
        names.append(name)
        rows.append(np.concatenate([numbers.mean(axis=0), numbers.std(axis=0)]))
    return Pictures(np.array(names), np.stack(rows), np.zeros((len(rows), 0)))
