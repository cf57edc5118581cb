"""Where a person's hand touches an object for a given way of holding it.

The hand is placed digit by digit. In a power grip a digit is in a plane and follows the convex
outline of the object's cross-section, like skin spanning a hollow; in a precision grip it touches
with its pad where a straight line from the grip's centre leaves the object. Lengths are fractions
of the hand's length, so that one description fits every person.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.contact_maps.outline import along_outline, convex_outline
from grasptypes.contact_maps.placement import HeldSurface, HumanHand, Placement

Array = NDArray[np.float64]


# Directions of thumb and fingers around the approach of a spread hand, degrees from the closing.
SPREAD_FINGERS_DEG = (-60.0, -20.0, 20.0, 60.0)
THUMB_DEG = 180.0


def handprint(surface: HeldSurface, grip: str, placement: Placement, hand: HumanHand) -> Array:
    """Contact (N,) between 0 and 1 of a hand that holds the surface with a grip of the table."""
    touches = _DIGITS[grip](surface, placement, hand)
    contact = np.max([np.zeros(len(surface.points_m)), *touches], axis=0)
    return np.asarray(contact * surface.mask)


def _wrap(surface: HeldSurface, place: Placement, hand: HumanHand) -> list[Array]:
    offsets = hand.finger_offsets_m()
    fingers = [
        _trace(surface, place, place.closing, offset, hand.finger_reach_m, hand)
        for offset in offsets
    ]
    thumb = _trace(surface, place, -place.closing, offsets[-1], hand.thumb_reach_m, hand)
    half_m = hand.breadth_m / 2
    palm = [
        _trace(surface, place, side * place.closing, 0.0, hand.palm_half_m, hand, half_m)
        for side in (1.0, -1.0)
    ]
    return [*fingers, thumb, *palm]


def _enclose(surface: HeldSurface, place: Placement, hand: HumanHand) -> list[Array]:
    reaches_m = dict.fromkeys(SPREAD_FINGERS_DEG, hand.finger_reach_m)
    digits = [
        _trace(surface, place, _around(place, angle_deg), 0.0, reach_m, hand)
        for angle_deg, reach_m in ({THUMB_DEG: hand.thumb_reach_m} | reaches_m).items()
    ]
    palm = _exit(surface, place.centre_m, place.palm_side, hand.pad_radius_m, np.inf)
    return digits if palm is None else [*digits, _pad(surface, palm, hand.palm_radius_m)]


def _tripod(surface: HeldSurface, place: Placement, hand: HumanHand) -> list[Array]:
    touched = []
    chosen = (THUMB_DEG, *np.linspace(-60.0, 60.0, place.fingers))
    for angle_deg in chosen:
        # A finger that would have to reach too far along a long object moves in towards the others.
        for share in (1.0, 0.5, 0.0):
            turn = THUMB_DEG if angle_deg == THUMB_DEG else share * angle_deg
            direction = _around(place, turn)
            point = _exit(surface, place.centre_m, direction, hand.pad_radius_m, hand.span_m)
            if point is not None:
                touched.append(_pad(surface, point, hand.pad_radius_m))
                break
    return touched


def _pinch(surface: HeldSurface, place: Placement, hand: HumanHand) -> list[Array]:
    return _oppose(surface, place, hand, hand.span_m)


def _rim(surface: HeldSurface, place: Placement, hand: HumanHand) -> list[Array]:
    """Like a pinch, but across the nearest wall instead of the whole object."""
    return _oppose(surface, place, hand, 2 * hand.pad_radius_m)


def _oppose(surface: HeldSurface, place: Placement, hand: HumanHand, reach_m: float) -> list[Array]:
    starts = [(0.0, -place.closing)]
    starts += [(offset, place.closing) for offset in hand.finger_offsets_m(place.fingers)]
    exits = [
        _exit(surface, place.centre_m + offset * place.axis, side, hand.pad_radius_m, reach_m)
        for offset, side in starts
    ]
    return [_pad(surface, point, hand.pad_radius_m) for point in exits if point is not None]


def _around(place: Placement, angle_deg: float) -> Array:
    angle = np.radians(angle_deg)
    return np.asarray(np.cos(angle) * place.closing + np.sin(angle) * place.axis)


def _exit(
    surface: HeldSurface, origin_m: Array, direction: Array, radius_m: float, reach_m: float
) -> int | None:
    """Index of the last point facing `direction` on a thick line from the origin, if any."""
    offset = surface.points_m - origin_m
    along = offset @ direction
    aside = np.linalg.norm(offset - along[:, None] * direction, axis=1)
    facing = (surface.normals @ direction > 0.35) & surface.mask & (along < reach_m)
    facing &= (aside < 0.6 * radius_m) & (along > -radius_m)
    return int(np.argmax(np.where(facing, along, -np.inf))) if facing.any() else None


def _pad(surface: HeldSurface, index: int, radius_m: float) -> Array:
    """Patch (N,) of the given radius around a point, on surface that faces the same way."""
    distance = np.linalg.norm(surface.points_m - surface.points_m[index], axis=1)
    return _plateau(distance / radius_m) * _facing(surface.normals @ surface.normals[index])


def _trace(
    surface: HeldSurface,
    place: Placement,
    direction: Array,
    offset_m: float,
    reach_m: float,
    hand: HumanHand,
    half_width_m: float | None = None,
) -> Array:
    """Contact (N,) of a digit from under the palm towards `direction`, `reach_m` along the outline.

    Args:
        offset_m: offset of the digit's plane from the centre, along the hand's axis.
        half_width_m: half the digit's breadth; default: a finger's.
    """
    width_m = hand.finger_half_width_m if half_width_m is None else half_width_m
    across = np.cross(place.palm_side, direction)
    shift = offset_m * place.axis
    offset = surface.points_m - place.centre_m - shift
    aside_m = offset @ across
    plane = np.column_stack([offset @ direction, offset @ place.palm_side])
    cut = surface.mask & (np.abs(aside_m) < hand.finger_half_width_m)
    contact = np.zeros(len(offset))
    outline = convex_outline(plane[cut])
    if outline is None:
        return contact
    near = np.flatnonzero(surface.mask & (np.abs(aside_m) < 1.5 * width_m))
    place_m, distance_m, normal = along_outline(outline, plane[near])
    facing = surface.normals[near] @ np.column_stack([direction, place.palm_side])
    contact[near] = (
        _plateau(aside_m[near] / width_m)
        * _plateau(distance_m / hand.softness_m / 2)
        * _plateau(np.maximum(place_m - reach_m, 0.0) / hand.softness_m)
        * _facing(np.sum(facing * normal, axis=1))
    )
    return contact


def _plateau(ratio: Array) -> Array:
    """1 well below a ratio of 1, 0.5 at 1, 0 well above: a patch with an edge, not a blur."""
    return np.asarray(np.exp2(-(np.abs(ratio) ** 4)))


def _facing(cosine: Array) -> Array:
    """0 for surfaces facing away from the skin, rising to 1 at 60 degrees."""
    return np.asarray(np.clip(2.0 * cosine, 0.0, 1.0))


_DIGITS = {"wrap": _wrap, "enclose": _enclose, "tripod": _tripod, "pinch": _pinch, "rim": _rim}
