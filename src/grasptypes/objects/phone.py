"""Cell phone with keys, in ContactDB's frame and size (metres)."""

from manifold3d import Manifold
from numpy.typing import ArrayLike

from grasptypes.objects import lofts, sections, solids
from grasptypes.objects.parts import Size, Solids


def cell_phone(size: Size) -> Solids:
    """The phone: back, front, bezel, screen, keys, menu_key and antenna."""
    front, back = _phone_covers(size)
    bezel, screen = _phone_display(size)
    menu = lofts.even_superellipse(size.menu_half_x_m, size.menu_half_y_m, 2.8)
    menu_key = _on_front(size, menu + [size.menu_x_m, size.middle_y_m], size.menu_height_m)
    return {
        "back": back,
        "front": front,
        "bezel": bezel,
        "screen": screen,
        "keys": _phone_keys(size),
        "menu_key": menu_key,
        "antenna": _phone_antenna(size),
    }


def _phone_shell(size: Size, raise_m: float = 0.0) -> Manifold:
    """Return the whole case, with its front raised by `raise_m`."""
    stations, values = lofts.interpolate_stations(size.stations, count=64)
    outlines = [
        lofts.crowned_section(
            half, back, front + raise_m, size.exponent, size.crown_m, size.crown_m
        )
        + [size.middle_y_m, 0.0]
        for half, back, front in values
    ]
    return lofts.loft_along("x", stations, outlines)


def _on_front(size: Size, outline: ArrayLike, raise_m: float) -> Manifold:
    """Return a slab of an outline (N, 2) in x, y that follows the front, raised above it."""
    return _phone_shell(size, raise_m) ^ solids.extrude(outline, 0.1, centred=False)


def _phone_covers(size: Size) -> tuple[Manifold, Manifold]:
    """Return the front and the back cover, with a seam around the case and speaker slots."""
    shell = _phone_shell(size)
    slab = solids.box((1.0, 1.0, size.seam_m)).translate((0.0, 0.0, size.seam_z_m))
    inset = 1 - 2 * size.seam_m / size.stations[4][1]
    seam = slab - shell.scale((inset, inset, 1.0))
    slot = solids.box((0.0012, 0.008, 0.0012), 0.0005)
    top_m = size.stations[8][3]
    slots = [
        slot.translate((size.speaker_x_m + shift, size.middle_y_m, top_m))
        for shift in (-0.003, 0.0, 0.003)
    ]
    back, front = solids.slabs(solids.difference(shell, seam, *slots), [size.seam_z_m])
    return front, back


def _phone_display(size: Size) -> tuple[Manifold, Manifold]:
    """Return the raised bezel, with a window, and the screen in it."""
    middle_x_m = (size.bezel_start_x_m + size.bezel_end_x_m) / 2
    length_m = size.bezel_end_x_m - size.bezel_start_x_m
    outline = lofts.even_superellipse(length_m / 2, size.bezel_width_m / 2, 3.5)
    window = sections.rounded_rectangle(size.screen_length_m, size.screen_width_m, 0.0012)
    place = [size.screen_x_m, size.middle_y_m]
    # Wider than the window, so that it reaches under the bezel.
    screen = _on_front(size, 1.02 * window + place, size.bezel_height_m - size.screen_recess_m)
    bezel = _on_front(size, outline + [middle_x_m, size.middle_y_m], size.bezel_height_m)
    return bezel - solids.extrude(window + place, 0.1, centred=False), screen


def _phone_keys(size: Size) -> Manifold:
    """Return the twelve number keys, the two call keys and the bar below them."""
    key = lofts.even_superellipse(size.key_half_x_m, size.key_half_y_m, 2.4)
    bar = lofts.even_superellipse(size.bar_half_x_m, size.bar_half_y_m, 3.0)
    places = [(x, y) for x in size.key_rows_x_m for y in size.key_columns_y_m]
    keys = [_on_front(size, key + place, size.key_height_m) for place in places]
    keys.append(_on_front(size, bar + [size.bar_x_m, size.middle_y_m], size.key_height_m / 2))
    calls = [
        _on_front(size, key + [size.menu_x_m, y], size.bezel_height_m + size.key_height_m)
        for y in (size.key_columns_y_m[0], size.key_columns_y_m[-1])
    ]
    return solids.union(*keys, *calls)


def _phone_antenna(size: Size) -> Manifold:
    radius_m, end_m = size.antenna_radius_m, size.antenna_end_x_m
    profile = sections.chain(
        [(0.0, size.antenna_start_x_m), (0.55 * radius_m, size.antenna_start_x_m)],
        [(radius_m, size.antenna_start_x_m + 0.006), (0.88 * radius_m, end_m - 0.0015)],
        [(0.6 * radius_m, end_m), (0.0, end_m)],
    )
    return solids.revolve(profile, axis="x", segments=48).translate(
        (0.0, size.antenna_y_m, size.antenna_z_m)
    )
