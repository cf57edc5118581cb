"""Hammer and flashlight, in ContactDB's frame and size (metres)."""

import numpy as np
from manifold3d import Manifold

from grasptypes.objects import lofts, sections, solids
from grasptypes.objects.parts import Size, Solids


def hammer(size: Size) -> Solids:
    """The hammer: head, face, claw and handle."""
    head, face = _hammer_head(size)
    return {
        "handle": _hammer_handle(size),
        "head": head,
        "face": face,
        "claw": _hammer_claw(size),
    }


def _hammer_handle(size: Size) -> Manifold:
    stations, halves = lofts.interpolate_stations(size.handle_stations)
    outlines = [
        lofts.even_superellipse(width, thickness, size.handle_exponent) + [size.handle_y_m, 0.0]
        for width, thickness in halves
    ]
    return lofts.loft_along("x", stations, outlines)


def _hammer_head(size: Size) -> tuple[Manifold, Manifold]:
    """Return the head's block with its neck, and the striking face."""
    chamfer = size.face_chamfer_m
    shoulder_m = size.head_end_y_m + 0.0015
    neck_overlap_m = 0.002
    neck = [
        (0.0, shoulder_m - neck_overlap_m),
        (size.face_radius_m - 0.0016, shoulder_m - neck_overlap_m),
        (size.face_radius_m - 0.0016, shoulder_m),
        (size.neck_radius_m, size.neck_y_m),
        (0.7 * size.neck_radius_m + 0.3 * size.face_radius_m, size.neck_y_m + 0.0035),
        (size.face_radius_m, size.face_start_y_m),
        (0.0, size.face_start_y_m),
    ]
    face = [
        (0.0, size.face_start_y_m),
        (size.face_radius_m, size.face_start_y_m),
        (size.face_radius_m, size.face_end_y_m - chamfer),
        (size.face_radius_m - chamfer, size.face_end_y_m),
        (0.0, size.face_end_y_m),
    ]
    length_m = size.head_end_y_m - size.head_start_y_m
    width_m = size.head_width_m
    block = solids.extrude(
        sections.rounded_rectangle(width_m, width_m, size.head_chamfer_m), length_m, axis="y"
    ).translate((size.head_x_m, size.head_start_y_m + length_m / 2, 0.0))
    turned = [
        solids.revolve(profile, axis="y").translate((size.head_x_m, 0.0, 0.0))
        for profile in (neck, face)
    ]
    return block + turned[0], turned[1]


def _hammer_claw(size: Size) -> Manifold:
    stations, curves = lofts.interpolate_stations(size.claw_stations, count=24)
    side = np.vstack(
        [
            np.column_stack([curves[:, 0], stations])[::-1],
            np.column_stack([curves[:, 1], stations]),
        ]
    )
    tip_m, root_m = size.claw_stations[0][0] - 0.001, size.head_start_y_m - 0.001
    half_gap_m = size.claw_gap_m / 2
    # When extruded along x, a polygon is in (-z, y).
    gap = solids.extrude(
        [(half_gap_m, tip_m), (0.0, root_m), (-half_gap_m, tip_m)], 2 * size.head_width_m, axis="x"
    ).translate((size.head_x_m, 0.0, 0.0))
    # Overlaps the head, since solids that only touch may stay separate in the union.
    key = solids.box((0.8 * size.head_width_m, 0.003, 0.8 * size.head_width_m))
    claw = solids.extrude(side, size.head_width_m) - gap
    return claw + key.translate((size.head_x_m, size.head_start_y_m + 0.001, 0.0))


def flashlight(size: Size) -> Solids:
    """The flashlight: body, tail, head, reflector, lens and button."""
    body, tail = _flashlight_body(size)
    head, reflector, lens = _flashlight_head(size)
    return {
        "body": body,
        "tail": tail,
        "head": head,
        "reflector": reflector,
        "lens": lens,
        "button": _flashlight_button(size),
    }


def _flashlight_body(size: Size) -> tuple[Manifold, Manifold]:
    """Return the tube with its grip grooves, and the tail cap."""
    radius_m, tail_z_m = size.body_radius_m, size.tail_z_m
    tube = [
        (0.0, size.collar_start_z_m - 0.003),
        (radius_m, size.collar_start_z_m - 0.003),
        (radius_m, tail_z_m - size.tail_chamfer_height_m),
        (radius_m - size.tail_chamfer_m, tail_z_m),
        (0.0, tail_z_m),
    ]
    cap_z_m = tail_z_m - size.tail_cap_height_m
    body, tail = solids.slabs(solids.revolve(tube), [cap_z_m])
    groove = solids.torus(radius_m + size.groove_depth_m, 2 * size.groove_depth_m)
    seam = solids.torus(radius_m, size.groove_depth_m).translate((0.0, 0.0, cap_z_m))
    grooves = [groove.translate((0.0, 0.0, z)) for z in size.grip_grooves_z_m]
    return solids.difference(body, seam, *grooves), tail - seam


def _flashlight_head(size: Size) -> tuple[Manifold, Manifold, Manifold]:
    """Return the lamp head, the conical reflector in it, and the lens."""
    shell = [
        (0.0, size.front_z_m),
        (size.front_radius_m, size.front_z_m),
        (size.bezel_radius_m, size.bezel_z_m),
        (size.head_radius_m, size.collar_end_z_m),
        (size.body_radius_m, size.collar_start_z_m),
        (0.0, size.collar_start_z_m),
    ]
    apex_m = size.reflector_z_m + size.reflector_depth_m
    slope = size.reflector_depth_m / size.reflector_radius_m
    lip_radius_m = size.front_radius_m - 0.0005
    lining_m = 0.0004
    hollow = [
        (0.0, size.front_z_m),
        (lip_radius_m, size.front_z_m),
        (size.reflector_radius_m, size.reflector_z_m),
        (0.0, apex_m),
    ]
    bowl = [
        (size.reflector_radius_m, size.reflector_z_m - lining_m),
        (size.reflector_radius_m, size.reflector_z_m + lining_m),
        (0.0, apex_m + lining_m),
        (0.0, apex_m - lining_m),
    ]
    lens_z_m = apex_m - size.lens_radius_m * slope
    lens = [(0.0, lens_z_m), (size.lens_radius_m, lens_z_m), (0.0, apex_m)]
    head, reflector = solids.revolve(shell), solids.revolve(bowl)
    sunk = solids.revolve(lens).translate((0.0, 0.0, lining_m / 2))
    return head - solids.revolve(hollow), reflector, sunk


def _flashlight_button(size: Size) -> Manifold:
    """Return the domed rubber switch, sunk into the body."""
    radius_m, top_m = size.button_radius_m, size.button_top_y_m
    profile = sections.chain(
        [(0.0, 0.75 * size.body_radius_m), (radius_m, 0.75 * size.body_radius_m)],
        [(0.88 * radius_m, top_m - 0.0022), (0.74 * radius_m, top_m - 0.0022)],
        [(0.45 * radius_m, top_m - 0.0006), (0.0, top_m)],
    )
    return solids.revolve(profile, axis="y").translate((0.0, 0.0, size.button_z_m))
