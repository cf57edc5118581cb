"""A hand and an object for the batched searches."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.hand import Hand
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.synthesis.fields import Field, field
from grasptypes.synthesis.hand_model import HandModel

Array = NDArray[np.float64]


class GraspScene(NamedTuple):
    """Input of the compiled functions; everything in the object frame."""

    hand: Hand
    model: HandModel
    """The hand, sampled."""
    field: Field
    """Signed distance to the object."""
    centre_of_mass_m: Array
    """(3,)."""
    radius_m: float
    """Half of the object's largest extent."""
    surface_m: Array
    """(n, 3) points on the object's surface."""


def grasp_scene(
    hand: Hand, model: HandModel, geometry: ObjectGeometry, surface_m: Array
) -> GraspScene:
    """The scene of a hand and a prepared object, with points (n, 3) on the object's surface."""
    radius_m = float(np.ptp(surface_m, axis=0).max() / 2)
    centre_m = np.array(geometry.properties.centre_of_mass_m)
    return GraspScene(hand, model, field(geometry.distance_grid), centre_m, radius_m, surface_m)
