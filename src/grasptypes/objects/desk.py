"""Computer mouse and stapler, in ContactDB's frame and size (metres)."""

import numpy as np
from manifold3d import Manifold

from grasptypes.objects import lofts, sections, solids
from grasptypes.objects.parts import Size, Solids


def mouse(size: Size) -> Solids:
    """The mouse: body, button_left, button_right and wheel."""
    shell = _mouse_shell(size)
    core = _mouse_shell(size, size.seam_depth_m)
    well = _mouse_wheel(size, size.wheel_gap_m)
    zone = _mouse_buttons_zone(size)
    seams = _mouse_seams(size) - core
    skin = solids.difference(shell, seams, well)
    # The core joins what the seams separate, and overlaps the buttons from below.
    body = (skin - zone) + (core - well)
    lids = (skin ^ zone) - _mouse_shell(size, 1.2 * size.seam_depth_m)
    right, left = solids.slabs(lids, [0.0], "y")
    return {
        "body": body,
        "button_left": left,
        "button_right": right,
        "wheel": _mouse_wheel(size),
    }


def _mouse_shell(size: Size, inset_m: float = 0.0) -> Manifold:
    """Return the outer shape, inset by `inset_m`."""
    stations, values = lofts.interpolate_stations(size.stations, count=72)
    outlines = [
        lofts.crowned_section(half, base, ridge, exponent, min(size.crown_m, 0.2 * (ridge - base)))
        for half, base, ridge, exponent in values
    ]
    shell = lofts.loft_along("x", stations, outlines)
    if inset_m == 0:
        return shell
    low, high = np.asarray(shell.bounding_box()).reshape(2, 3)
    middle = (low + high) / 2
    factors = 1 - 2 * inset_m / (high - low)
    return shell.translate(tuple(-middle)).scale(tuple(factors)).translate(tuple(middle))


def _mouse_buttons_zone(size: Size) -> Manifold:
    """Return the block that cuts both buttons from the shell."""
    length_m, height_m = 0.2, 0.1
    block = solids.box((length_m, 2 * size.buttons_side_y_m, height_m))
    return block.translate(
        (size.buttons_end_x_m - length_m / 2, 0.0, size.buttons_low_z_m + height_m / 2)
    )


def _mouse_seams(size: Size) -> Manifold:
    """Return the cutters of the seams around and between the buttons."""
    long_m, high_m, seam_m = 0.2, 0.1, size.seam_m
    end_m, low_m = size.buttons_end_x_m, size.buttons_low_z_m
    lengthwise = solids.box((long_m, seam_m, high_m)).translate(
        (end_m - long_m / 2, 0.0, low_m + high_m / 2)
    )
    across = solids.box((seam_m, 2 * size.buttons_side_y_m, high_m)).translate(
        (end_m, 0.0, low_m + high_m / 2)
    )
    side_m = size.buttons_side_y_m
    return solids.union(
        across, *(lengthwise.translate((0.0, y, 0.0)) for y in (-side_m, 0, side_m))
    )


def _mouse_wheel(size: Size, gap_m: float = 0.0) -> Manifold:
    """Return the visible segment of the wheel or, with a gap, the well it turns in."""
    radius_m, half_m = size.wheel_radius_m + gap_m, size.wheel_half_width_m + gap_m
    rim = sections.superellipse(radius_m, half_m, 3.2, 64)
    wheel = solids.revolve(rim[rim[:, 0] >= -1e-9], axis="y", segments=96).translate(
        (size.wheel_x_m, 0.0, size.wheel_z_m)
    )
    bottom_m = size.wheel_bottom_z_m + (size.wheel_sunk_m if gap_m else 0.0)
    return solids.slabs(wheel, [bottom_m])[1]


def stapler(size: Size) -> Solids:
    """The stapler: base, anvil, hinge, pin, magazine and cover."""
    # It carries the cover, its heads showing on both sides.
    pin = solids.cylinder(size.pin_radius_m, size.cover_width_m + 2 * size.pin_head_m, axis="y")
    return {
        "base": _stapler_base(size),
        "anvil": _stapler_anvil(size),
        "hinge": _stapler_hinge(size),
        "pin": pin.translate((size.pin_x_m, 0.0, size.pin_z_m)),
        "magazine": _block(size.magazine_x_m, size.magazine_width_m, size.magazine_z_m),
        "cover": _stapler_cover(size),
    }


def _stapler_base(size: Size) -> Manifold:
    outlines = [
        sections.rounded_rectangle(end - start, width, 0.0012) + [(start + end) / 2, 0.0]
        for (start, end), width in (
            (size.base_bottom_x_m, size.base_bottom_width_m),
            (size.base_top_x_m, size.base_top_width_m),
        )
    ]
    return lofts.loft_along("z", [size.base_bottom_z_m, size.base_top_z_m], outlines)


def _block(x_m: tuple[float, float], width_m: float, z_m: tuple[float, float]) -> Manifold:
    """Return a box from ranges in x and z, centred in y."""
    box = solids.box((x_m[1] - x_m[0], width_m, z_m[1] - z_m[0]))
    return box.translate(((x_m[0] + x_m[1]) / 2, 0.0, (z_m[0] + z_m[1]) / 2))


def _stapler_anvil(size: Size) -> Manifold:
    top_m = size.base_top_z_m
    plate = _block(size.anvil_x_m, size.anvil_width_m, (top_m - 0.001, top_m + size.anvil_height_m))
    middle_m = sum(size.anvil_x_m) / 2
    dent = solids.ellipsoid((0.0016, 0.0052, 0.0003))
    return plate - dent.translate((middle_m + 0.006, 0.0, top_m + size.anvil_height_m))


def _stapler_hinge(size: Size) -> Manifold:
    """Return the bracket: two cheeks joined by a plate on the base."""
    low_m = size.base_top_z_m - 0.0005
    outer = _block(size.hinge_x_m, size.hinge_outer_width_m, (low_m, size.hinge_top_z_m))
    inner = _block((-1.0, 1.0), size.hinge_outer_width_m - 2 * size.hinge_wall_m, (-1.0, 1.0))
    plate = _block(size.hinge_x_m, 0.9 * size.hinge_outer_width_m, (low_m, size.hinge_bar_z_m))
    middle_x_m = sum(size.hinge_x_m) / 2
    opening = _block((middle_x_m - 0.016, middle_x_m + 0.016), 0.0112, (-1.0, 1.0))
    return (outer - inner) + (plate - opening)


def _stapler_cover(size: Size) -> Manifold:
    """Return the channel-shaped cover, open towards the magazine."""
    side = np.asarray(size.cover_side)
    # When extruded along -y, a polygon is in (x, z).
    channel = solids.extrude(side, size.cover_width_m, axis="-y")
    inside = solids.extrude(side, size.cover_width_m - 2 * size.cover_wall_m, axis="-y")
    front_m = 0.6 * size.cover_wall_m
    lowered = inside.translate((-front_m, 0.0, -size.cover_wall_m))
    behind = _block((-1.0, 0.0), size.cover_width_m - 2 * size.cover_wall_m, (-1.0, 0.009))
    below = inside.translate((-front_m, 0.0, -0.008))
    return solids.difference(channel, lowered, below, behind)
