"""Closed turned objects in ContactDB's frame and size: water bottle and light bulb."""

import numpy as np
from manifold3d import Manifold

from grasptypes.objects import sections, solids
from grasptypes.objects.parts import Size, Solids


def water_bottle(size: Size) -> Solids:
    """The water bottle: cap, neck, shoulder, label and body."""
    foot = size.foot_radius_m
    turn = np.radians(np.linspace(0, 90, 17))
    sine, cosine = np.sin(turn), np.cos(turn)
    low_z = size.bottom_height_m + size.foot_round_height_m * (1 - cosine)
    low = np.column_stack([foot + (size.body_radius_m - foot) * sine, low_z])
    rise_m = size.neck_height_m + 0.0008 - size.shoulder_height_m
    rise = np.column_stack([size.body_radius_m * cosine, size.shoulder_height_m + rise_m * sine])
    dimple = [
        (0.0, size.bottom_height_m + size.dimple_height_m),
        (size.dimple_radius_m / 2, size.bottom_height_m + size.dimple_height_m),
        (size.dimple_radius_m, size.bottom_height_m),
    ]
    vessel = solids.revolve(sections.chain(dimple, low, rise))
    body, label, shoulder = solids.slabs(
        vessel - _petal_grooves(size), [size.label_bottom_m, size.label_top_m]
    )
    neck = _disc(size.neck_radius_m, size.shoulder_height_m, size.cap_bottom_m + 0.001)
    collar = _disc(
        size.cap_radius_m, size.collar_height_m, size.collar_height_m + size.collar_thickness_m
    )
    return {
        "cap": _disc(size.cap_radius_m, size.cap_bottom_m, size.cap_top_m),
        "neck": neck + collar,
        "shoulder": shoulder,
        "label": label,
        "body": body,
    }


def _disc(radius_m: float, bottom_m: float, top_m: float) -> Manifold:
    return solids.cylinder(radius_m, top_m - bottom_m).translate((0, 0, (bottom_m + top_m) / 2))


def _petal_grooves(size: Size) -> Manifold:
    """Return the V grooves between the feet: wedges whose ridge climbs outwards."""
    (start_r, start_z), (end_r, end_z) = size.groove_start_m, size.groove_end_m
    slope = (end_z - start_z) / (end_r - start_r)
    reach = np.array([0.0, 1.3 * size.body_radius_m])
    ridge = start_z + slope * (reach - start_r)
    floor_m = size.bottom_height_m - 0.001
    half_width = np.maximum(ridge - floor_m, 1e-4) * np.tan(np.radians(size.groove_half_angle_deg))
    wedge = solids.loft(
        [
            [(radius, -width, floor_m), (radius, width, floor_m), (radius, 0.0, top)]
            for radius, width, top in zip(reach, half_width, ridge, strict=True)
        ]
    )
    turns = 180.0 + 360.0 * np.arange(size.grooves) / size.grooves
    return solids.union(*(wedge.rotate((0, 0, turn)) for turn in turns))


def light_bulb(size: Size) -> Solids:
    """The light bulb: glass, screw_base, insulator and contact_tip."""
    ball = sections.arc(
        (0.0, size.ball_centre_x_m), size.ball_radius_m, size.ball_start_deg, 90, 48
    )
    side = sections.smooth_curve([*size.neck_profile_m, *ball[:2]], 32)
    glass = sections.chain([(0.0, side[0, 1])], side, ball[2:])
    insulator = sections.chain(
        [(0.0, size.tip_end_x_m + 0.0010)],
        [(size.tip_radius_m, size.tip_end_x_m + 0.0010)],
        size.shell_profile_m,
        [(0.0, size.shell_profile_m[-1][1])],
    )
    tip_m = 0.004
    tip = solids.cylinder(size.tip_radius_m, tip_m).translate((0, 0, size.tip_end_x_m + tip_m / 2))
    return {
        "glass": solids.along(solids.revolve(glass), "x"),
        "screw_base": solids.along(_screw_base(size), "x"),
        "insulator": solids.revolve(insulator, "x"),
        "contact_tip": solids.along(tip, "x"),
    }


def _screw_base(size: Size) -> Manifold:
    """Return the base, upright: a sleeve with ridges as coarse as the thread in the scan."""
    start, end = size.base_start_x_m, size.neck_profile_m[0][1]
    sleeve = sections.chain(
        [(0.0, size.shell_profile_m[-1][1])],
        [size.shell_profile_m[-1]],
        [(size.thread_root_radius_m, start), (size.thread_root_radius_m, end + 0.001)],
        [(0.0, end + 0.001)],
    )
    ridge = sections.superellipse(
        2 * (size.thread_crest_radius_m - size.thread_root_radius_m) / 2,
        0.35 * size.thread_pitch_m,
        samples=24,
    )
    first = start + 0.6 * size.thread_pitch_m
    return solids.revolve(sleeve) + solids.union(
        *(
            solids.revolve(ridge + [size.thread_root_radius_m, first + turn * size.thread_pitch_m])
            for turn in range(size.thread_turns)
        )
    )
