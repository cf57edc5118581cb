"""Open vessels in ContactDB's frame and size: bowl, cup, mug and wine glass (opening +z)."""

import numpy as np
from manifold3d import Manifold

from grasptypes.objects import sections, solids
from grasptypes.objects.parts import Size, Solids


def bowl(size: Size) -> Solids:
    """The bowl: rim, wall and foot."""
    start = -np.degrees(np.arccos(size.foot_radius_m / size.outer_radius_m))
    end = -np.degrees(
        np.arcsin((size.inner_centre_height_m - size.rim_height_m) / size.inner_radius_m)
    )
    outer = sections.chain(
        [(0.0, size.bottom_height_m), (size.foot_radius_m, size.bottom_height_m)],
        sections.arc((0.0, size.rim_height_m), size.outer_radius_m, start, 0.0, 32),
    )
    inner = sections.arc((0.0, size.inner_centre_height_m), size.inner_radius_m, -90, end, 40)
    solid = solids.revolve(sections.wall_profile(outer, inner))
    foot, wall, rim = solids.slabs(solid, [size.foot_height_m, size.rim_height_m - size.rim_band_m])
    return {
        "rim": rim,
        "wall": wall,
        "foot": foot,
    }


def cup(size: Size) -> Solids:
    """The cup: rim, wall and base."""
    outer = sections.chain(
        [(0.0, size.outer_profile_m[0][1])], sections.smooth_curve(size.outer_profile_m)
    )
    inner = sections.chain(
        [(0.0, size.inner_profile_m[0][1])], sections.smooth_curve(size.inner_profile_m)
    )
    bottom_m, top_m = outer[0, 1], outer[-1, 1]
    base, wall, rim = solids.slabs(
        solids.revolve(sections.wall_profile(outer, inner)),
        [bottom_m + size.base_band_m, top_m - size.rim_band_m],
    )
    return {
        "rim": rim,
        "wall": wall,
        "base": base,
    }


def mug(size: Size) -> Solids:
    """The mug: rim, wall, base and handle."""
    edge, radius = size.edge_radius_m, size.outer_radius_m
    outer = sections.chain(
        [(0.0, size.bottom_height_m)],
        sections.arc((radius - edge, size.bottom_height_m + edge), edge, -90, 0, 7),
        sections.arc((radius - edge, size.rim_height_m - edge), edge, 0, 90, 7),
    )
    inner = [
        (0.0, size.floor_height_m),
        (size.inner_radius_m, size.floor_height_m),
        (size.inner_radius_m, size.rim_height_m),
    ]
    solid = solids.revolve(sections.wall_profile(outer, inner)).translate((size.axis_x_m, 0, 0))
    base, wall, rim = solids.slabs(
        solid,
        [size.bottom_height_m + size.base_band_m, size.rim_height_m - size.rim_band_m],
    )
    return {
        "rim": rim,
        "wall": wall,
        "base": base,
        "handle": _mug_handle(size),
    }


def _mug_handle(size: Size) -> Manifold:
    """Sweep half an ellipse, thicker at its ends, and cut it off inside the wall."""
    turn = np.radians(np.linspace(-100, 100, 49))
    wall_m = size.axis_x_m + size.outer_radius_m
    half_axes_m = [size.handle_reach_m, size.handle_half_height_m]
    ellipse = half_axes_m * np.column_stack([np.cos(turn), np.sin(turn)])
    path = sections.in_xz([wall_m, size.handle_centre_height_m] + ellipse)
    half = size.handle_half_width_m
    thickness = half + (size.handle_root_half_thickness_m - half) * np.sin(turn) ** 2
    scales = np.column_stack([thickness / half, np.ones_like(turn)])
    swept = solids.sweep(path, sections.circle(half, 32), scales, up=(0, 1, 0))
    mid_wall_m = (size.outer_radius_m + size.inner_radius_m) / 2
    keep_out = solids.cylinder(mid_wall_m, 0.3).translate((size.axis_x_m, 0, 0))
    return swept - keep_out


def wine_glass(size: Size) -> Solids:
    """The wine glass: bowl, stem and base."""
    curve = sections.smooth_curve(size.outer_profile_m, samples=64)
    hollow = sections.offset_curve(curve, size.wall_thickness_m)
    hollow = hollow[
        (hollow[:, 1] > size.cavity_height_m) & (hollow[:, 0] > size.cavity_floor_radius_m)
    ]
    rim_m = curve[-1, 1]
    hollow[-1, 1] = rim_m
    # The bowl overlaps the stem, since solids that only touch may stay separate.
    root_m = size.cavity_height_m - size.stem_radius_m
    outer = sections.chain([(0.0, root_m), (0.98 * size.stem_radius_m, root_m)], curve)
    inner = sections.chain(
        [(0.0, size.cavity_height_m), (size.cavity_floor_radius_m, size.cavity_height_m)], hollow
    )
    inner = inner[inner[:, 1] <= rim_m]
    stem_m = size.cavity_height_m - size.bottom_height_m - 0.001
    return {
        "bowl": solids.revolve(sections.wall_profile(outer, inner)),
        "stem": solids.cylinder(size.stem_radius_m, stem_m).translate(
            (0, 0, size.bottom_height_m + stem_m / 2)
        ),
        "base": solids.cylinder(size.foot_radius_m, size.foot_thickness_m, segments=96).translate(
            (0, 0, size.bottom_height_m + size.foot_thickness_m / 2)
        ),
    }
