"""Best viewpoint of a grasp: neither the object nor the fingers should be hidden."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.states import HandStates
from grasptypes.hands.surface import surface_points

Array = NDArray[np.float64]

AZIMUTHS = 24
# Distance between points on the hand, and width of the depth-buffer cells: wide enough that a
# surface leaves no cell empty.
SPACING_M, CELL_M = 0.006, 0.010


def finger_points(state: HandStates) -> tuple[Array, Array]:
    """Points (n, 3) on the fingers and (m, 3) on the rest of one hand, in the object's frame."""
    surface = surface_points(state.hand, SPACING_M)
    own = state.link_poses()[0, surface.link_index]
    points = np.einsum("nij,nj->ni", own[:, :3, :3], surface.points_m) + own[:, :3, 3]
    on_finger = np.isin(surface.link_index, state.hand.finger_links)
    return points[on_finger], points[~on_finger]


def best_azimuth(thing: Array, fingers: Array, rest: Array, elevation_rad: float) -> float:
    """Direction around the object's z axis from which object and fingers are seen best, radians.

    For each of the two, the visible area is taken as a share of the largest area it shows from any
    side; the direction maximises the product of both shares.

    Args:
        thing: (N, 3) points on the object, fingers: (n, 3), rest: (m, 3) of the hand.
    """
    angles = np.linspace(-np.pi, np.pi, AZIMUTHS, endpoint=False)
    areas = np.array([_areas((thing, fingers, rest), angle, elevation_rad) for angle in angles])
    shares = areas[:, :2] / np.maximum(areas[:, 2:].max(axis=0), 1)
    return float(angles[shares.prod(axis=1).argmax()])


def _areas(
    groups: tuple[Array, Array, Array], azimuth_rad: float, elevation_rad: float
) -> tuple[int, int, int, int]:
    """Cells in which object and fingers are in front, and cells that they cover, hidden or not."""
    sine, cosine = np.sin(azimuth_rad), np.cos(azimuth_rad)
    flat, up = np.cos(elevation_rad), np.sin(elevation_rad)
    axes = np.array([[-sine, cosine, 0.0], [-up * cosine, -up * sine, flat]])
    towards = np.array([flat * cosine, flat * sine, up])
    cells = [np.floor(points @ axes.T / CELL_M).astype(int) for points in groups]
    least = np.min([cell.min(axis=0) for cell in cells], axis=0)
    size = np.max([cell.max(axis=0) for cell in cells], axis=0) - least + 1
    nearest = np.full((len(groups), *size), -np.inf)
    for layer, cell, points in zip(nearest, cells, groups, strict=True):
        np.maximum.at(layer, tuple((cell - least).T), points @ towards)
    front = nearest.argmax(axis=0)[np.isfinite(nearest.max(axis=0))]
    filled = np.isfinite(nearest).sum(axis=(1, 2))
    return int((front == 0).sum()), int((front == 1).sum()), int(filled[0]), int(filled[1])
