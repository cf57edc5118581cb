"""Plane and spatial curves from the points of a kind's description."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from grasptypes.kinds import lofts, sections
from grasptypes.kinds.solid_description import Lobes, Section

Curve = NDArray[np.float64]

# Samples of a smooth curve between two of its points, and the turn between two of a rounded corner.
SPLINE_SAMPLES, CORNER_DEG = 8, 12.0
# A circle's samples are about this far apart, but never fewer or more than these.
SPACING_M, FEWEST, MOST = 0.0015, 12, 64
SMOOTH = "smooth"


def round_samples(radius_m: float) -> int:
    """Number of samples of a circle, a multiple of 4."""
    return 4 * round(float(np.clip(2 * np.pi * radius_m / SPACING_M, FEWEST, MOST)) / 4)


def curve(
    points: Sequence[tuple[Any, ...]], smooth: bool, closed: bool = False, dimensions: int = 2
) -> Curve:
    """Trace evaluated points: corners, rounded corners, and smooth stretches.

    Args:
        points: rows of coordinates, each with an optional corner radius (metres) or `smooth`.
        smooth: whether all points lie on one smooth curve.
        closed: whether the first point follows the last.
        dimensions: coordinates of a point, 2 or 3.

    Returns:
        (N, dimensions) points; the first is not repeated at the end of a closed curve.

    Raises:
        ValueError: a point has too few or too many numbers.
    """
    for number, point in enumerate(points, 1):
        if not dimensions <= len(point) <= dimensions + 1 or SMOOTH in point[:dimensions]:
            raise ValueError(
                f"point {number} needs {dimensions} coordinates, "
                "and may have a corner radius or 'smooth'"
            )
    at = np.array([point[:dimensions] for point in points], dtype=np.float64)
    if smooth:
        return _spline(np.vstack([at, at[:1]]) if closed else at, closed)
    kinds = [point[dimensions] if len(point) > dimensions else 0.0 for point in points]
    pieces: list[Curve] = []
    for is_smooth, run in groupby(range(len(points)), lambda index: kinds[index] == SMOOTH):
        indices = list(run)
        if is_smooth and len(indices) > 1:
            pieces.append(_spline(at[indices]))
            continue
        for index in indices:
            radius = 0.0 if is_smooth else float(kinds[index])
            inner = closed or 0 < index < len(points) - 1
            around = at[index - 1], at[index], at[(index + 1) % len(points)]
            pieces.append(_corner(*around, radius) if radius > 0 and inner else at[index][None])
    return sections.chain(*pieces)


def _spline(at: Curve, closed: bool = False) -> Curve:
    """Points on a spline through (K, D) points; the first point of a closed one is its last."""
    samples = SPLINE_SAMPLES * (len(at) - 1)
    if not closed:
        return sections.smooth_curve(at, samples + 1)
    chord = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(at, axis=0), axis=1))])
    spline = CubicSpline(chord, at, bc_type="periodic")
    return np.asarray(spline(np.linspace(0.0, chord[-1], samples, endpoint=False)))


def _corner(before: Curve, corner: Curve, after: Curve, radius_m: float) -> Curve:
    """An arc that rounds a corner, with as large a radius as fits between the corners."""
    to, fro = before - corner, after - corner
    lengths: tuple[float, float] = (float(np.linalg.norm(to)), float(np.linalg.norm(fro)))
    if min(lengths) < 1e-12:
        return corner[None]
    to, fro = to / lengths[0], fro / lengths[1]
    half_angle = np.arccos(np.clip(to @ fro, -1, 1)) / 2
    if not 1e-3 < half_angle < np.pi / 2 - 1e-3:
        return corner[None]
    reach = min(float(radius_m / np.tan(half_angle)), 0.4999 * min(lengths))
    radius_m = float(reach * np.tan(half_angle))
    middle = (to + fro) / np.linalg.norm(to + fro)
    centre = corner + middle * radius_m / np.sin(half_angle)
    start = (corner + to * reach - centre) / radius_m
    end = (corner + fro * reach - centre) / radius_m
    sweep = np.pi - 2 * half_angle
    count = max(3, int(np.degrees(sweep) / CORNER_DEG) + 2)
    share = np.linspace(0, 1, count)[:, None]
    arc = (np.sin((1 - share) * sweep) * start + np.sin(share * sweep) * end) / np.sin(sweep)
    return np.asarray(centre + radius_m * arc)


def outline(section: Section) -> Curve:
    """Trace an evaluated figure counter-clockwise, (N, 2)."""
    if section.circle is not None:
        traced = _circle(section)
    elif section.ellipse is not None:
        half_x, half_y, exponent = (*section.ellipse, 2.0)[:3]
        samples = round_samples(max(half_x, half_y))
        traced = lofts.even_superellipse(half_x, half_y, exponent, samples)
    elif section.rectangle is not None:
        traced = _rectangle(*section.rectangle)
    elif section.polygon is not None:
        traced = _polygon(section)
    else:
        assert section.outline is not None
        traced = curve(section.outline, section.smooth, closed=True)
        ahead = np.roll(traced, -1, axis=0)
        if (traced[:, 0] * ahead[:, 1] - traced[:, 1] * ahead[:, 0]).sum() < 0:
            traced = traced[::-1]
    angle = np.radians(section.turn)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return np.asarray(traced @ turn + np.asarray(section.at))


def _circle(section: Section) -> Curve:
    radius_m, lobes = float(section.circle or 0.0), section.lobes
    if lobes is None:
        return sections.circle(radius_m, round_samples(radius_m))
    circle = sections.circle(radius_m, 12 * lobes.count)
    return circle * furrow_factors(circle, lobes)[:, None]


def furrow_factors(points: Curve, lobes: Lobes) -> Curve:
    """Factors (N,) on the distance of points (N, 2) from the axis, 1 between furrows."""
    angle = np.arctan2(points[:, 1], points[:, 0])
    return np.asarray(1 - lobes.depth * (0.5 - 0.5 * np.cos(lobes.count * angle)))


def _rectangle(width_m: float, height_m: float, radius_m: float = 0.0) -> Curve:
    corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * [width_m / 2, height_m / 2]
    if radius_m <= 0:
        return corners
    largest_m = 0.4999 * min(width_m, height_m)
    return sections.rounded_rectangle(width_m, height_m, min(radius_m, largest_m))


def _polygon(section: Section) -> Curve:
    polygon = section.polygon
    assert polygon is not None
    points = polygon.sides if polygon.inner is None else 2 * polygon.sides
    radii = np.full(points, polygon.radius, dtype=np.float64)
    if polygon.inner is not None:
        radii[1::2] = polygon.inner
    angles = 2 * np.pi * np.arange(points) / points
    return np.asarray(radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles)]))
