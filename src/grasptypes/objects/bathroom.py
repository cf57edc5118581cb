"""Toothbrush and toothpaste, in ContactDB's frame and size (metres)."""

import numpy as np
from manifold3d import Manifold

from grasptypes.objects import lofts, sections, solids
from grasptypes.objects.parts import Size, Solids


def toothbrush(size: Size) -> Solids:
    """The toothbrush: handle, grip_pad, neck, head and bristles."""
    stem = _toothbrush_stem(size)
    head, neck, handle = solids.slabs(stem, [size.head_end_x_m, size.neck_end_x_m], "x")
    return {
        "handle": handle,
        "grip_pad": _toothbrush_pad(size),
        "neck": neck,
        "head": head,
        "bristles": _toothbrush_bristles(size),
    }


def _toothbrush_stem(size: Size, swell_m: float = 0.0) -> Manifold:
    stations, values = lofts.interpolate_stations(size.stations, count=90)
    ring = sections.circle(1.0, 32)
    outlines = [ring * (radius + swell_m) + [y, z] for y, z, radius in values]
    return lofts.loft_along("x", stations, outlines)


def _toothbrush_pad(size: Size) -> Manifold:
    """Return the thumb pad on the handle's back, opposite the bristles."""
    length_m = size.pad_end_x_m - size.pad_start_x_m
    outline = sections.rounded_rectangle(length_m, size.pad_width_m, 0.49 * size.pad_width_m)
    rows = np.asarray(size.stations)
    middle_x_m = (size.pad_start_x_m + size.pad_end_x_m) / 2
    middle = [np.interp(middle_x_m, rows[:, 0], rows[:, column]) for column in (1, 2)]
    stamp = solids.extrude(outline, 0.02, axis="y", centred=False)
    return _toothbrush_stem(size, size.pad_height_m) ^ stamp.translate((middle_x_m, *middle))


def _toothbrush_bristles(size: Size) -> Manifold:
    """Return the bristle block, its free end slit into tufts."""
    height_m = size.bristles_start_y_m - size.bristles_end_y_m
    outline = lofts.even_superellipse(
        size.bristles_length_m / 2, size.bristles_width_m / 2, exponent=4.0
    )
    block = solids.extrude(outline, height_m, axis="y")
    low_m = -height_m / 2 + size.tuft_depth_m / 2
    slits = []
    for extent_m, cut in (
        (size.bristles_length_m, (size.tuft_gap_m, size.tuft_depth_m, 0.02)),
        (size.bristles_width_m, (0.04, size.tuft_depth_m, size.tuft_gap_m)),
    ):
        count = int(extent_m / size.tuft_pitch_m) - 1
        at = (np.arange(count) - (count - 1) / 2) * size.tuft_pitch_m
        axis = 0 if cut[0] < cut[2] else 2
        slits += [solids.box(cut).translate((x * (axis == 0), low_m, x * (axis == 2))) for x in at]
    tufts = solids.difference(block, *slits).rotate((0.0, 0.0, size.bristles_tilt_deg))
    middle_y_m = (size.bristles_start_y_m + size.bristles_end_y_m) / 2
    return tufts.translate((size.bristles_x_m, middle_y_m, size.stations[3][2]))


def toothpaste(size: Size) -> Solids:
    """The tube: body, fold, label, stripe, shoulder and cap."""
    body = _tube_body(size)
    middle_m = (size.label_start_x_m + size.label_end_x_m) / 2
    label = _between(_tube_body(size, size.print_m), size.label_start_x_m, size.label_end_x_m)
    stripe = _between(
        _tube_body(size, 2 * size.print_m),
        middle_m - size.stripe_width_m / 2,
        middle_m + size.stripe_width_m / 2,
    )
    fold = solids.box((0.0093, 2 * size.stations[0][1], size.fold_thickness_m))
    return {
        "body": body,
        "label": label,
        "stripe": stripe,
        "fold": fold.translate((size.fold_x_m + 0.00465, 0.0, 0.0)),
        "shoulder": _tube_shoulder(size),
        "cap": _tube_cap(size),
    }


def _tube_body(size: Size, swell_m: float = 0.0) -> Manifold:
    stations, halves = lofts.interpolate_stations(size.stations, count=48)
    outlines = [sections.superellipse(y + swell_m, z + swell_m) for y, z in halves]
    return lofts.loft_along("x", stations, outlines)


def _between(solid: Manifold, low_m: float, high_m: float) -> Manifold:
    return solids.slabs(solid, [low_m, high_m], "x")[1]


def _tube_shoulder(size: Size) -> Manifold:
    """Return the cone from the tube to the threaded neck."""
    start_m, _, radius_m = size.stations[-1]
    profile = [
        (0.0, start_m - 0.002),
        (0.95 * radius_m, start_m - 0.002),
        (radius_m, start_m),
        (size.neck_radius_m, size.shoulder_end_x_m),
        (size.neck_radius_m, size.cap_start_x_m + 0.001),
        (0.0, size.cap_start_x_m + 0.001),
    ]
    return solids.revolve(profile, axis="x", segments=64)


def _tube_cap(size: Size) -> Manifold:
    """Return the tapered cap with its ridges."""
    samples = 8 * size.cap_ridges
    angles = 2 * np.pi * np.arange(samples) / samples
    wave = size.cap_ridge_m / 2 * np.cos(size.cap_ridges * angles)
    chamfer_m = 0.0008
    rows = (
        (size.cap_start_x_m, size.cap_start_radius_m),
        (size.cap_end_x_m - chamfer_m, size.cap_end_radius_m),
        (size.cap_end_x_m, size.cap_end_radius_m - chamfer_m),
    )
    rings = [(radius + wave)[:, None] * sections.circle(1.0, samples) for _, radius in rows]
    return lofts.loft_along("x", [x for x, _ in rows], rings)
