"""The spacing of a user's distance grid, wide enough for a limited number of nodes."""

from __future__ import annotations

from dataclasses import replace
from itertools import count
from math import prod

import numpy as np

from grasptypes.objects.distance_grid import grid_shape
from grasptypes.objects.parts import ImportedModel
from grasptypes.settings.objects import ImportLimits, Resolution

# The spacing grows in steps of this share of it.
STEP = 0.05


def limited(
    imported: ImportedModel, resolution: Resolution, limits: ImportLimits
) -> tuple[ImportedModel, Resolution]:
    """A model, and the resolution at which its distance grid keeps the limit of nodes.

    Distances beyond the grid's margin become lower bounds. If the grid has to be coarser, the
    model's repairs say so.
    """
    corners = [part.solid.bounding_box() for part in imported.model.parts]
    box_m = imported.scale * np.reshape(corners, (-1, 2, 3))
    low_m = box_m[:, 0].min(axis=0) - resolution.grid_margin_m
    high_m = box_m[:, 1].max(axis=0) + resolution.grid_margin_m
    wanted_m = resolution.grid_spacing_m
    spacings_m = (wanted_m * (1 + STEP * number) for number in count())
    spacing_m = next(
        spacing_m
        for spacing_m in spacings_m
        if prod(grid_shape(low_m, high_m, spacing_m)) <= limits.max_grid_nodes
    )
    resolution = resolution.changed(grid_capped=True)
    if spacing_m == wanted_m:
        return imported, resolution
    note = f"spaced the distance grid at {1e3 * spacing_m:.1f} mm, as the object is large"
    repairs = (*imported.repairs, note)
    return replace(imported, repairs=repairs), resolution.changed(grid_spacing_m=spacing_m)
