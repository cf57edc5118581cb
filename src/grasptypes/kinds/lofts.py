"""Bodies lofted along a coordinate axis through smoothly changing sections (metres)."""

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold
from numpy.typing import ArrayLike, NDArray

from grasptypes.kinds import sections
from grasptypes.objects import solids

Array = NDArray[np.float64]


def loft_along(axis: str, stations_m: ArrayLike, outlines: Sequence[ArrayLike]) -> Manifold:
    """Loft outlines placed at increasing stations along x, y or z.

    The outlines keep the object's own axes.

    Args:
        axis: "x" (outlines in y, z), "y" (outlines in x, z) or "z" (outlines in x, y).
        stations_m: (K,) increasing positions along the axis.
        outlines: K polygons (N, 2), counter-clockwise in the axes named above.
    """
    index = "xyz".index(axis)
    rings = np.insert(
        np.asarray(outlines, dtype=np.float64),
        index,
        np.asarray(stations_m, dtype=np.float64)[:, None],
        axis=2,
    )
    # (x, z) is left-handed when seen along y.
    return solids.loft(rings[:, ::-1] if axis == "y" else rings)


def interpolate_stations(table: ArrayLike, count: int = 40) -> tuple[Array, Array]:
    """Interpolate a table of stations without overshoot, with the densest samples at both ends.

    Args:
        table: (K, 1 + D) rows of a position and D values there, positions increasing.
        count: number of positions to return.

    Returns:
        (count,) positions and (count, D) values.
    """
    rows = np.asarray(table, dtype=np.float64)
    ramp = (1 - np.cos(np.pi * np.linspace(0, 1, count))) / 2
    at = rows[0, 0] + (rows[-1, 0] - rows[0, 0]) * ramp
    return at, sections.monotone_curve(rows[:, 0], rows[:, 1:], at)


def even_superellipse(
    half_x_m: float, half_y_m: float, exponent: float, samples: int = 64
) -> Array:
    """Trace a superellipse counter-clockwise with points evenly spaced along its length."""
    dense = sections.superellipse(half_x_m, half_y_m, exponent, 1024)
    closed = np.vstack([dense, dense[:1]])
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    at = np.linspace(0, length[-1], samples, endpoint=False)
    return np.column_stack([np.interp(at, length, closed[:, axis]) for axis in range(2)])


def crowned_section(
    half_width_m: float,
    bottom_m: float,
    top_m: float,
    exponent: float,
    top_crown_m: float = 0.0,
    bottom_crown_m: float = 0.0,
) -> Array:
    """Trace a rounded rectangle whose top and bottom bulge, (96, 2), counter-clockwise.

    Args:
        half_width_m: half width across the first axis, centred on 0.
        bottom_m: lowest point on the second axis, at the middle.
        top_m: highest point on the second axis, at the middle.
        exponent: of the superellipse; 2 is an ellipse, larger ones have sharper corners.
        top_crown_m: how much lower the top is at the sides.
        bottom_crown_m: how much higher the bottom is at the sides.
    """
    low, high = bottom_m + bottom_crown_m, top_m - top_crown_m
    outline = even_superellipse(half_width_m, (high - low) / 2, exponent, samples=96)
    above = outline[:, 1] / (high - low) + 0.5
    bulge = 1 - (outline[:, 0] / half_width_m) ** 2
    outline[:, 1] += (low + high) / 2
    outline[:, 1] += bulge * (top_crown_m * above - bottom_crown_m * (1 - above))
    return outline
