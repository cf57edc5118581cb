"""Plane curves and polygons (metres) to turn, extrude, loft and sweep."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator

Curve = NDArray[np.float64]


def smooth_curve(points: ArrayLike, samples: int = 48) -> Curve:
    """Draw a cubic spline through control points, parametrised by chord length.

    Args:
        points: (K, D) control points, K >= 2.
        samples: number of points to return, evenly spaced in chord length.

    Returns:
        (samples, D) points on the curve.
    """
    control = np.asarray(points, dtype=np.float64)
    chord = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(control, axis=0), axis=1))])
    spline = CubicSpline(chord, control, bc_type="natural")
    return np.asarray(spline(np.linspace(0.0, chord[-1], samples)))


def monotone_curve(stations: ArrayLike, values: ArrayLike, at: ArrayLike) -> Curve:
    """Interpolate values over increasing stations without overshoot (PCHIP).

    Args:
        stations: (K,) strictly increasing positions, for example heights.
        values: (K,) or (K, D) values at the stations, for example radii.
        at: (N,) positions to evaluate.

    Returns:
        (N,) or (N, D) values.
    """
    curve = PchipInterpolator(np.asarray(stations), np.asarray(values), axis=0)
    return np.asarray(curve(np.asarray(at)))


def chain(*curves: ArrayLike) -> Curve:
    """Join curves end to end into one (N, D) polyline, dropping repeated joints."""
    points = np.vstack([np.atleast_2d(np.asarray(curve, dtype=np.float64)) for curve in curves])
    keep = np.ones(len(points), dtype=bool)
    keep[1:] = np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9
    return points[keep]


def arc(
    centre: Sequence[float], radius_m: float, start_deg: float, end_deg: float, samples: int = 13
) -> Curve:
    """Sample a circular arc, (samples, 2), from start to end angle (either sense)."""
    angles = np.radians(np.linspace(start_deg, end_deg, samples))
    return np.asarray(centre) + radius_m * np.column_stack([np.cos(angles), np.sin(angles)])


def superellipse(
    half_x_m: float, half_y_m: float, exponent: float = 2.0, samples: int = 64
) -> Curve:
    """Trace |x/a|^n + |y/b|^n = 1 counter-clockwise, (samples, 2).

    Exponent 2 is an ellipse; larger ones tend to a rectangle.
    """
    angles = 2.0 * np.pi * np.arange(samples) / samples
    cosine, sine = np.cos(angles), np.sin(angles)
    power = 2.0 / exponent
    return np.column_stack(
        [
            half_x_m * np.sign(cosine) * np.abs(cosine) ** power,
            half_y_m * np.sign(sine) * np.abs(sine) ** power,
        ]
    )


def circle(radius_m: float, samples: int = 48) -> Curve:
    """Trace a circle counter-clockwise, (samples, 2)."""
    return superellipse(radius_m, radius_m, samples=samples)


def rounded_rectangle(
    size_x_m: float, size_y_m: float, radius_m: float, corner_samples: int = 8
) -> Curve:
    """Trace a rectangle with rounded corners counter-clockwise, (4 * corner_samples, 2)."""
    x, y = size_x_m / 2 - radius_m, size_y_m / 2 - radius_m
    corners = (((x, y), 0), ((-x, y), 90), ((-x, -y), 180), ((x, -y), 270))
    return np.vstack(
        [arc(centre, radius_m, turn, turn + 90, corner_samples) for centre, turn in corners]
    )


def in_xz(curve: ArrayLike) -> Curve:
    """Put a plane curve (N, 2) into the plane y = 0: (N, 3)."""
    return np.insert(np.asarray(curve, dtype=np.float64), 1, 0.0, axis=1)


def offset_curve(curve: ArrayLike, distance_m: float) -> Curve:
    """Move each point of a (N, 2) open curve to the left of its direction of travel.

    The curve should bend with radii above the distance; otherwise the result folds over.
    """
    points = np.asarray(curve, dtype=np.float64)
    tangents = np.gradient(points, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    return points + distance_m * np.column_stack([-tangents[:, 1], tangents[:, 0]])
