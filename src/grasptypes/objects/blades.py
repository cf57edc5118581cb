"""Knife and scissors, in ContactDB's frame and size (metres)."""

import numpy as np
from manifold3d import Manifold
from numpy.typing import ArrayLike, NDArray

from grasptypes.objects import lofts, sections, solids
from grasptypes.objects.parts import Size, Solids


def knife(size: Size) -> Solids:
    """The knife: handle, rivets, bolster and blade."""
    handle, bolster = solids.slabs(_knife_handle(size), [size.bolster_y_m], "y")
    return {
        "handle": handle,
        "rivets": _knife_rivets(size),
        "bolster": bolster,
        "blade": _knife_blade(size),
    }


def _knife_handle(size: Size) -> Manifold:
    stations, values = lofts.interpolate_stations(size.handle_stations, count=60)
    outlines = [
        lofts.even_superellipse((belly - back) / 2, thickness, size.handle_exponent)
        + [(belly + back) / 2, 0.0]
        for back, belly, thickness in values
    ]
    return lofts.loft_along("y", stations, outlines)


def _knife_rivets(size: Size) -> Manifold:
    rows = np.asarray(size.handle_stations)
    half_m = rows[:, 3].max() + size.rivet_height_m
    rivet = solids.cylinder(size.rivet_radius_m, 2 * half_m)
    middle = sections.monotone_curve(rows[:, 0], rows[:, 1:3].mean(axis=1), size.rivets_y_m)
    return solids.union(
        *(rivet.translate((x, y, 0.0)) for x, y in zip(middle, size.rivets_y_m, strict=True))
    )


def _knife_blade(size: Size) -> Manifold:
    stations, values = lofts.interpolate_stations(size.blade_stations, count=48)
    outlines = [_blade_section(size, *row) for row in values]
    blade = lofts.loft_along("y", stations, outlines)
    curve = sections.smooth_curve(size.heel_curve, samples=24)
    beyond = curve[-1] + [0.02, 0.0]
    waste = np.vstack([curve, [beyond], [(beyond[0], curve[0, 1] - 0.01)], curve[:1] - [0.0, 0.01]])
    return blade - solids.extrude(waste, 0.02)


def _blade_section(size: Size, spine_m: float, edge_m: float, half_m: float) -> NDArray[np.float64]:
    """Trace a wedge (8, 2) in x, z from the spine to a bevelled edge."""
    width_m = edge_m - spine_m
    back_m = spine_m + min(size.spine_bevel_m, 0.2 * width_m)
    bevel_m = edge_m - min(size.edge_bevel_m, 0.2 * width_m)
    thin_m, tip_m = size.edge_thickness * half_m, 0.03 * half_m
    lower = [(spine_m, -half_m / 2), (back_m, -half_m), (bevel_m, -thin_m), (edge_m, -tip_m)]
    return np.array(lower + [(x, -z) for x, z in reversed(lower)])


def scissors(size: Size) -> Solids:
    """The scissors: blade_left, blade_right, loop_left, loop_right and pivot."""
    blade = _scissors_blade(size)
    loop = _scissors_loop(size)
    centre = (0.0, size.pivot_y_m, size.rivet_bottom_m)
    height_m = size.rivet_top_m - size.rivet_bottom_m
    pivot, hole = (
        solids.extrude(sections.circle(radius_m), height_m, centred=False).translate(centre)
        for radius_m in (size.rivet_radius_m, size.rivet_hole_radius_m)
    )
    shapes = {
        "blade_left": blade.mirror((1.0, 0.0, 0.0)),
        "blade_right": blade.mirror((0.0, 0.0, 1.0)),
        "loop_left": loop.rotate((0.0, 180.0, 0.0)) + _scissors_stop(size),
        "loop_right": loop,
        "pivot": pivot,
    }
    tilt_deg = (0.0, size.tilt_deg, 0.0)
    return {name: (solid - hole).rotate(tilt_deg) for name, solid in shapes.items()}


def _scissors_blade(size: Size) -> Manifold:
    """Return the blade right of the middle with its pivot disc on the upper layer.

    It reaches slightly below z = 0, so that the two halves join, and is flush with the underside of
    the loop's plastic shank.
    """
    low_m, high_m = -size.blade_inset_m, size.half_thickness_m - size.blade_inset_m
    lug = sections.circle(size.pivot_radius_m) + [0.0, size.pivot_y_m]
    inner_m, radius_m = -size.blade_inner_x_m, size.tip_radius_m
    ends = [(size.tip_outer_x_m - radius_m, radius_m), (-size.tip_inner_x_m + radius_m, radius_m)]
    tips = [sections.circle(r, 24) + [x, size.tip_y_m + r] for x, r in ends]
    back = [
        (size.pivot_radius_m, size.pivot_y_m),
        (inner_m, size.pivot_y_m),
        (inner_m, size.pivot_y_m - 0.0115),
    ]
    halves: tuple[list[ArrayLike], ...] = ([back, *tips], [lug])
    side, disc = (
        Manifold.batch_hull(
            [
                solids.extrude(outline, high_m - low_m, centred=False).translate((0.0, 0.0, low_m))
                for outline in outlines
            ]
        )
        for outlines in halves
    )
    return side + disc


def _scissors_loop(size: Size) -> Manifold:
    """Return the right finger loop, full thickness, and its shank on the upper layer."""
    centre = (size.loop_x_m, size.loop_y_m)
    outer = sections.rounded_rectangle(
        size.loop_width_m, size.loop_length_m, size.bow_outer_radius_m, 14
    )
    hole = sections.rounded_rectangle(
        size.loop_width_m - 2 * size.loop_wall_m,
        size.loop_length_m - 2 * size.loop_wall_m,
        size.bow_outer_radius_m - size.loop_wall_m,
        14,
    )
    ring = solids.extrude(outer + centre, 2 * size.half_thickness_m, holes=[hole + centre])
    shank = [
        (size.pivot_radius_m, size.pivot_y_m + 0.002),
        (0.92 * size.loop_x_m, size.loop_y_m - size.loop_length_m / 2 + 0.001),
        (0.0030, 0.0085),
        (-0.0037, size.pivot_y_m + 0.0110),
        (0.0, size.pivot_y_m),
    ]
    arm = solids.extrude(shank, size.half_thickness_m + size.blade_inset_m, centred=False)
    arm = arm.translate((0.0, 0.0, -size.blade_inset_m))
    return ring + (arm - solids.extrude(hole + centre, 1.0))


def _scissors_stop(size: Size) -> Manifold:
    """Return the bump between the loops, on the left one."""
    height_m = 2 * (size.half_thickness_m - size.blade_inset_m)
    bump = solids.cylinder(size.stop_radius_m, height_m)
    inner_edge_m = size.loop_width_m / 2 - size.loop_x_m
    return bump.translate((inner_edge_m - 0.4 * size.stop_radius_m, size.stop_y_m, 0.0))
