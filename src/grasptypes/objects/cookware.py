"""Pan and Utah teapot in ContactDB's frame and size (opening +z)."""

from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold

from grasptypes.objects import sections, solids
from grasptypes.objects.parts import Material, ObjectModel, Part

DARK_METAL = Material((0.20, 0.20, 0.22, 1.0), metallic=0.3, roughness=0.45)
STEEL = Material((0.62, 0.63, 0.65, 1.0), metallic=0.4, roughness=0.35)
HANDLE_PLASTIC = Material((0.08, 0.07, 0.07, 1.0), roughness=0.55)
GLAZE = Material((0.78, 0.72, 0.56, 1.0), roughness=0.3)
GLAZE_DARK = Material((0.52, 0.30, 0.16, 1.0), roughness=0.3)

Rows = tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class Pan:
    """Frying pan, tilted about y as in the scan, with its handle towards +x.

    The vessel's heights are along its own axis; the handle's are along z.

    Attributes:
        handle_stations_m: rows of x, lower z, upper z.
    """

    tilt_deg: float = 2.95
    axis_x_m: float = -0.0111
    floor_radius_m: float = 0.0527
    corner_radius_m: float = 0.0126
    wall_slope_deg: float = 59.8
    bottom_height_m: float = -0.0109
    rim_height_m: float = 0.0172
    rim_radius_m: float = 0.0750
    rim_width_m: float = 0.0029
    bead_height_m: float = 0.0035
    wall_thickness_m: float = 0.0019
    bracket_width_m: float = 0.0128
    bracket_outline_m: Rows = (
        (0.0545, -0.0033),
        (0.0710, -0.0040),
        (0.0710, 0.0102),
        (0.0626, 0.0103),
    )
    handle_width_m: float = 0.0151
    handle_stations_m: Rows = (
        (0.0675, -0.0048, 0.0112),
        (0.0800, -0.0004, 0.0122),
        (0.1000, 0.0060, 0.0158),
        (0.1200, 0.0096, 0.0191),
        (0.1360, 0.0091, 0.0192),
        (0.1507, 0.0072, 0.0172),
    )
    handle_edge_exponent: float = 5.0
    hole_start_x_m: float = 0.1290
    hole_end_x_m: float = 0.1416
    hole_width_m: float = 0.0057


def pan(size: Pan = Pan()) -> ObjectModel:
    """Build the pan with parts rim, body, bracket and handle."""
    body, rim = (
        solids.revolve(profile).translate((size.axis_x_m, 0, 0)).rotate((0, size.tilt_deg, 0))
        for profile in _pan_profiles(size)
    )
    bracket = solids.extrude(
        [(x, -z) for x, z in size.bracket_outline_m[::-1]], size.bracket_width_m, axis="y"
    )
    parts = (
        Part("rim", rim, STEEL),
        Part("body", body, DARK_METAL),
        Part("bracket", bracket, STEEL),
        Part("handle", _pan_handle(size), HANDLE_PLASTIC, density_kg_m3=1400.0),
    )
    return ObjectModel(parts, density_kg_m3=7850.0)


def _pan_profiles(size: Pan) -> tuple[sections.Curve, sections.Curve]:
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


def _pan_handle(size: Pan) -> Manifold:
    """Loft the handle along x, round its end in plan view, and cut the hole for hanging it."""
    rows = np.asarray(size.handle_stations_m)
    stations = np.linspace(rows[0, 0], rows[-1, 0], 40)
    outlines = []
    for low, high in sections.monotone_curve(rows[:, 0], rows[:, 1:], stations):
        outline = sections.superellipse(
            (high - low) / 2, size.handle_width_m / 2, size.handle_edge_exponent, 48
        )
        # When lofting along x, the first axis of the outline points to -z.
        outlines.append(outline - [(low + high) / 2, 0.0])
    bar = solids.stack(outlines, stations, axis="x")
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


@dataclass(frozen=True)
class UtahTeapot:
    """The Utah teapot with its lid on, spout +x and handle -x.

    Attributes:
        body_profile_m, lid_profile_m: rows of radius, height.
        handle_path_m: rows of x, z of the handle's centre line.
        spout_stations_m: rows of lower x, lower z, upper x, upper z, half width along y.
    """

    axis_x_m: float = -0.0015
    body_profile_m: Rows = (
        (0.0513, -0.0395),
        (0.0531, -0.0371),
        (0.0599, -0.0314),
        (0.0666, -0.0224),
        (0.0684, -0.0143),
        (0.0663, -0.0002),
        (0.0610, 0.0148),
        (0.0535, 0.0310),
    )
    foot_radius_m: float = 0.0440
    bottom_height_m: float = -0.0442
    lip_radius_m: float = 0.0505
    lip_height_m: float = 0.0385
    lid_profile_m: Rows = (
        (0.0436, 0.0370),
        (0.0412, 0.0381),
        (0.0282, 0.0406),
        (0.0180, 0.0422),
        (0.0095, 0.0442),
        (0.0057, 0.0475),
        (0.0075, 0.0510),
        (0.0111, 0.0550),
        (0.0124, 0.0575),
        (0.0106, 0.0595),
        (0.0067, 0.0603),
    )
    lid_height_m: float = 0.0606
    handle_path_m: Rows = (
        (-0.0480, 0.0268),
        (-0.0770, 0.0266),
        (-0.0877, 0.0255),
        (-0.0949, 0.0230),
        (-0.0986, 0.0187),
        (-0.0989, 0.0131),
        (-0.0973, 0.0070),
        (-0.0933, -0.0005),
        (-0.0868, -0.0078),
        (-0.0775, -0.0145),
        (-0.0600, -0.0230),
    )
    handle_half_width_m: float = 0.0076
    handle_half_thickness_m: float = 0.0040
    handle_root_half_thickness_m: float = 0.0052
    spout_stations_m: Rows = (
        (0.0450, -0.0260, 0.0450, 0.0030, 0.0170),
        (0.0566, -0.0243, 0.0566, 0.0032, 0.0168),
        (0.0690, -0.0211, 0.0647, 0.0038, 0.0165),
        (0.0838, -0.0104, 0.0750, 0.0083, 0.0145),
        (0.0904, 0.0038, 0.0801, 0.0157, 0.0115),
        (0.0950, 0.0186, 0.0832, 0.0242, 0.0085),
        (0.1036, 0.0311, 0.0874, 0.0323, 0.0067),
        (0.1114, 0.0356, 0.0908, 0.0356, 0.0063),
        (0.1155, 0.0381, 0.0950, 0.0376, 0.0058),
    )


def utah_teapot(size: UtahTeapot = UtahTeapot()) -> ObjectModel:
    """Build the teapot, closed by its lid, with parts body, lid, handle and spout."""
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
    parts = (
        Part("body", _on_axis(body, size), GLAZE),
        Part("lid", _on_axis(lid, size), GLAZE_DARK),
        Part("handle", _teapot_handle(size), GLAZE_DARK),
        Part("spout", _teapot_spout(size), GLAZE),
    )
    return ObjectModel(parts, density_kg_m3=2300.0, shell_thickness_m=0.004)


def _on_axis(profile: sections.Curve, size: UtahTeapot) -> Manifold:
    return solids.revolve(profile).translate((size.axis_x_m, 0, 0))


def _teapot_handle(size: UtahTeapot) -> Manifold:
    path = sections.smooth_curve(size.handle_path_m, 56)
    path = np.column_stack([path[:, 0], np.zeros(len(path)), path[:, 1]])
    along = np.linspace(0, 1, len(path))
    thin, root = size.handle_half_thickness_m, size.handle_root_half_thickness_m
    scales = np.column_stack([(thin + (root - thin) * along**2) / thin, np.ones_like(along)])
    section = sections.superellipse(thin, size.handle_half_width_m, 2.3, 40)
    return solids.sweep(path, section, scales, up=(0, 1, 0))


def _teapot_spout(size: UtahTeapot) -> Manifold:
    rows = sections.smooth_curve(size.spout_stations_m, 48)
    low = np.column_stack([rows[:, 0], np.zeros(len(rows)), rows[:, 1]])
    high = np.column_stack([rows[:, 2], np.zeros(len(rows)), rows[:, 3]])
    unit = sections.circle(1.0, 40)
    across = np.outer(rows[:, 4], [0.0, 1.0, 0.0])
    rings = (
        ((low + high) / 2)[:, None]
        + unit[None, :, :1] * ((low - high) / 2)[:, None]
        + unit[None, :, 1:] * across[:, None]
    )
    return solids.loft(rings)
