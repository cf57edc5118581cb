"""Where the hand of a grasp touches an object, and whether it is on parts that must stay free."""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand
from grasptypes.hands.surface import surface_points
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.planning.plan_contacts import PlanContacts
from grasptypes.segmentation.true_roles import nearest_facing
from grasptypes.settings.holds import TouchSettings

Array = NDArray[np.float64]


def touching(
    hand: Hand, grid: DistanceGrid, numbers: ArrayLike, touch: TouchSettings
) -> tuple[Array, Array]:
    """Points (n, 3) of the hand's surface that touch the object, in its frame, with the normals
    that the object has there; at least the nearest one.

    Args:
        numbers: see `hands.configuration`.
    """
    posed = configuration.unpack(np.asarray(numbers))
    poses = posed.T_object_hand @ hand.link_poses(hand.couple(posed.dofs))
    surface = surface_points(hand, touch.hand_spacing_m)
    T = poses[surface.link_index]
    points = np.einsum("pij,pj->pi", T[:, :3, :3], surface.points_m) + T[:, :3, 3]
    distance_m, outward = grid.distance_and_gradient(points)
    near = distance_m <= max(touch.touch_m, float(distance_m.min()))
    return points[near], outward[near]


def touches_avoided(
    grasps: pd.DataFrame,
    contacts: PlanContacts,
    hand: Hand,
    grid: DistanceGrid,
    touch: TouchSettings,
    trace: float,
) -> NDArray[np.bool_]:
    """Which valid grasps (G,) touch parts that their contacts avoid.

    Args:
        grasps: with the columns `valid` and `hand_configuration`.
        trace: share of the contact that does not count.
    """
    seen, avoided = contacts.contact_map, list(contacts.avoided)
    result = np.zeros(len(grasps), dtype=bool)
    if not avoided:
        return result
    points_m, normals = seen.points.astype(np.float64), seen.normals.astype(np.float64)
    wrong = np.isin(seen.part_names, avoided)[seen.part_index]
    for row in np.flatnonzero(grasps.valid):
        where = touching(hand, grid, grasps.hand_configuration.iloc[row], touch)
        result[row] = wrong[nearest_facing(points_m, normals, *where)].mean() > trace
    return result
