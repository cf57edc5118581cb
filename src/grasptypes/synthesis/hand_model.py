"""The hand for batched searches: points on its links, and distance grids of its links."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hand import kinematics
from grasptypes.hand.shapes import link_meshes, surface_points
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.settings.synthesis import SynthesisSettings
from grasptypes.synthesis.fields import Fields, fields

Array = NDArray[np.float64]

PALM, FIRST_PROXIMAL, FIRST_DISTAL = 0, 3, 6
"""Indices into `kinematics.LINK_NAMES`."""
# Distance grid of each link: the three fingers share theirs.
GRID_OF_LINK = np.array([0, 1, 2, 3, 3, 3, 4, 4, 4])


class HandModel(NamedTuple):
    """Points of all links, one link after another, and one distance grid per kind of link."""

    points: Array
    """(n, 3) on the surface of each link, in its own frame, metres."""
    starts: NDArray[np.int64]
    """(10,) start of each link's points, and the end of the last."""
    centres: Array
    """(9, 3) centre of each link's bounding sphere, in its own frame, metres."""
    radii: Array
    """(9,) radius of that sphere, metres."""
    grid_of_link: NDArray[np.int64]
    """(9,) index into `grids`."""
    grids: Fields
    """Signed distances to the links' surfaces."""


@cache
def hand_model(
    finger_spacing_m: float, base_spacing_m: float, grid_spacing_m: float, range_m: float
) -> HandModel:
    """Sample the hand.

    Args:
        finger_spacing_m: distance between neighbouring points on the fingers.
        base_spacing_m: the same on palm and knuckles, which are larger and touch less often.
        grid_spacing_m: distance between the nodes of the links' distance grids.
        range_m: margin of the grids around the links.
    """
    base, fingers = surface_points(base_spacing_m), surface_points(finger_spacing_m)
    of_base, of_fingers = base.link_index < FIRST_PROXIMAL, fingers.link_index >= FIRST_PROXIMAL
    links = np.concatenate([base.link_index[of_base], fingers.link_index[of_fingers]])
    points = np.concatenate([base.points_m[of_base], fingers.points_m[of_fingers]])
    counts = np.bincount(links, minlength=len(kinematics.LINK_NAMES))
    meshes = link_meshes()
    lowest = np.array([mesh.bounds[0] for mesh in meshes])
    highest = np.array([mesh.bounds[1] for mesh in meshes])
    centres = (lowest + highest) / 2
    corners = [mesh.vertices - centre for mesh, centre in zip(meshes, centres, strict=True)]
    kinds = [meshes[list(GRID_OF_LINK).index(kind)] for kind in range(GRID_OF_LINK.max() + 1)]
    return HandModel(
        points=np.ascontiguousarray(points),
        starts=np.concatenate([[0], np.cumsum(counts)]),
        centres=centres,
        radii=np.array([np.linalg.norm(corner, axis=1).max() for corner in corners]),
        grid_of_link=GRID_OF_LINK,
        grids=fields(
            [
                DistanceGrid.from_mesh(
                    np.asarray(mesh.vertices), np.asarray(mesh.faces), grid_spacing_m, range_m
                )
                for mesh in kinds
            ]
        ),
    )


class HandModels(NamedTuple):
    """The hand at two resolutions."""

    search: HandModel
    """Coarse, for thousands of candidates."""
    check: HandModel
    """Fine, for the verdict."""


def sample_hand(settings: SynthesisSettings) -> HandModels:
    """The hand at the resolutions of the settings."""
    how, reach_m = settings.hand, settings.energy.range_m
    check_m, grid_m = how.check_spacing_m, how.grid_spacing_m
    return HandModels(
        hand_model(how.finger_spacing_m, how.base_spacing_m, grid_m, reach_m),
        hand_model(check_m, check_m, grid_m, reach_m),
    )
