"""Convex outlines of cross-sections, which a closing finger follows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, cKDTree

Array = NDArray[np.float64]

# Step along an outline; far below the breadth of a finger.
OUTLINE_STEP_M = 0.001


def convex_outline(cut: Array) -> Array | None:
    """Closed convex outline (K, 2) of a cut, clockwise from above its centre; None if too thin.

    Clockwise is from the palm (+y) towards the digit's direction (+x).
    """
    if len(cut) < 8 or np.ptp(cut, axis=0).min() < 1e-3:
        return None
    corners = cut[ConvexHull(cut).vertices[::-1]]
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    inside = corners[:, 0].min() < 0.0 < corners[:, 0].max()
    x0 = 0.0 if inside else middle[0]
    following = np.roll(corners, -1, axis=0)
    crossing = np.flatnonzero((corners[:, 0] <= x0) & (following[:, 0] > x0))
    if len(crossing) == 0:
        return None
    edge = int(crossing[np.argmax(corners[crossing, 1])])
    before, after = corners[edge], following[edge]
    share = (x0 - before[0]) / (after[0] - before[0])
    start = before + share * (after - before)
    ring = np.roll(corners, -(edge + 1), axis=0)
    return np.vstack([start, ring, start])


def along_outline(outline: Array, points: Array) -> tuple[Array, Array, Array]:
    """Arc length (N,), distance (N,) and outward normal (N, 2) of the outline nearest to points.

    The outline is sampled at points `OUTLINE_STEP_M` apart.
    """
    step = np.diff(outline, axis=0)
    length = np.linalg.norm(step, axis=1)
    bounds = np.concatenate([[0.0], np.cumsum(length)])
    arc = np.arange(0.0, bounds[-1], OUTLINE_STEP_M)
    edge = np.searchsorted(bounds, arc, side="right") - 1
    tangent = step[edge] / length[edge, None]
    chain = outline[edge] + (arc - bounds[edge])[:, None] * tangent
    distance, nearest = cKDTree(chain).query(points)
    normals = np.column_stack([-tangent[:, 1], tangent[:, 0]])
    return arc[nearest], distance, normals[nearest]
