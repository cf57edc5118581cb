"""Pan and Utah teapot in ContactDB's frame and size (opening +z)."""

import numpy as np
from manifold3d import Manifold

from grasptypes.objects import lofts, sections, solids
from grasptypes.objects.parts import Size, Solids


def pan(size: Size) -> Solids:
    """The pan: rim, body, bracket and handle."""
    body, rim = (
        solids.revolve(profile).translate((size.axis_x_m, 0, 0)).rotate((0, size.tilt_deg, 0))
        for profile in _pan_profiles(size)
    )
    bracket = solids.extrude(
        [(x, -z) for x, z in size.bracket_outline_m[::-1]], size.bracket_width_m, axis="y"
    )
    return {
        "rim": rim,
        "body": body,
        "bracket": bracket,
        "handle": _pan_handle(size),
    }


def _pan_profiles(size: Size) -> tuple[sections.Curve, sections.Curve]:
    """Return the (radius, height) polygons of the upright body and of its rim bead."""
    middle_m = size.rim_height_m - size.bead_height_m / 2
    corner = sections.arc(
        (size.floor_radius_m, size.bottom_height_m + size.corner_radius_m),
        size.corner_radius_m,
        -90,
        size.wall_slope_deg - 90,
        13,
    )
    slope = np.tan(np.radians(size.wall_slope_deg))
    end = (corner[-1, 0] + (middle_m - corner[-1, 1]) / slope, middle_m)
    outer = sections.chain(corner, np.linspace(corner[-1], end, 12))
    inner = sections.offset_curve(outer, size.wall_thickness_m)
    body = sections.wall_profile(
        sections.chain([(0.0, size.bottom_height_m)], outer),
        sections.chain([(0.0, inner[0, 1])], inner),
    )
    bead = sections.rounded_rectangle(size.rim_width_m, size.bead_height_m, 0.0007)
    return body, bead + [size.rim_radius_m - size.rim_width_m / 2, middle_m]


def _pan_handle(size: Size) -> Manifold:
    """Loft the handle along x, round its end in plan view, and cut the hole for hanging it."""
    rows = np.asarray(size.handle_stations_m)
    stations = np.linspace(rows[0, 0], rows[-1, 0], 40)
    # Turned onto x, the first axis of an outline points to -z.
    outlines = [
        sections.superellipse(
            (high - low) / 2, size.handle_width_m / 2, size.handle_edge_exponent, 48
        )
        - [(low + high) / 2, 0.0]
        for low, high in sections.monotone_curve(rows[:, 0], rows[:, 1:], stations)
    ]
    bar = solids.along(lofts.loft_along("z", stations, outlines), "x")
    half = size.handle_width_m / 2
    middle_m = rows[-1, 0] - half
    plan = solids.cylinder(half * 1.02, 0.1).translate((middle_m, 0, 0)) + solids.box(
        (0.2, 0.1, 0.1)
    ).translate((middle_m - 0.1, 0, 0))
    hole_m = size.hole_end_x_m - size.hole_start_x_m
    slot = sections.rounded_rectangle(hole_m, size.hole_width_m, 0.45 * size.hole_width_m)
    hole = solids.extrude(slot, 0.1).translate(
        ((size.hole_start_x_m + size.hole_end_x_m) / 2, 0, 0)
    )
    return (bar ^ plan) - hole


def utah_teapot(size: Size) -> Solids:
    """The teapot, closed by its lid,: body, lid, handle and spout."""
    body = sections.chain(
        [(0.0, size.bottom_height_m), (0.6 * size.foot_radius_m, size.bottom_height_m + 0.0004)],
        [(size.foot_radius_m, size.bottom_height_m + 0.0016)],
        sections.smooth_curve(size.body_profile_m, 64),
        [(size.lip_radius_m, size.lip_height_m), (0.0, size.lip_height_m)],
    )
    lid = sections.chain(
        [(0.0, size.bottom_height_m / 2), (size.lid_profile_m[0][0], 0.0)],
        sections.smooth_curve(size.lid_profile_m, 64),
        [(0.0, size.lid_height_m)],
    )
    return {
        "body": _on_axis(body, size),
        "lid": _on_axis(lid, size),
        "handle": _teapot_handle(size),
        "spout": _teapot_spout(size),
    }


def _on_axis(profile: sections.Curve, size: Size) -> Manifold:
    return solids.revolve(profile).translate((size.axis_x_m, 0, 0))


def _teapot_handle(size: Size) -> Manifold:
    path = sections.in_xz(sections.smooth_curve(size.handle_path_m, 56))
    along = np.linspace(0, 1, len(path))
    thin, root = size.handle_half_thickness_m, size.handle_root_half_thickness_m
    scales = np.column_stack([(thin + (root - thin) * along**2) / thin, np.ones_like(along)])
    section = sections.superellipse(thin, size.handle_half_width_m, 2.3, 40)
    return solids.sweep(path, section, scales, up=(0, 1, 0))


def _teapot_spout(size: Size) -> Manifold:
    rows = sections.smooth_curve(size.spout_stations_m, 48)
    low, high = sections.in_xz(rows[:, :2]), sections.in_xz(rows[:, 2:4])
    unit = sections.circle(1.0, 40)
    across = np.outer(rows[:, 4], [0.0, 1.0, 0.0])
    rings = (
        ((low + high) / 2)[:, None]
        + unit[None, :, :1] * ((low - high) / 2)[:, None]
        + unit[None, :, 1:] * across[:, None]
    )
    return solids.loft(rings)
