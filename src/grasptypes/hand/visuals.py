"""What the hand looks like: solids by material, carved from the same dimensions as its parts."""

from functools import cache
from typing import NamedTuple

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray

from grasptypes.hand import kinematics, parts

Array = NDArray[np.float64]

# Colours (RGBA) judged by eye from photographs of the BarrettHand: black anodised body, bare
# aluminium inner links, dark rubber on the gripping faces.
MATERIALS = {
    "anodised": (0.13, 0.13, 0.15, 1.0),
    "aluminium": (0.60, 0.61, 0.63, 1.0),
    "rubber": (0.06, 0.06, 0.065, 1.0),
}
SEGMENTS = 48
CLEARANCE_M = 0.0006
PAD_M = 0.002
SEAM_M = 0.0015


class Visual(NamedTuple):
    """The part of a link of one material: vertices (n, 3) m in its frame, triangles (m, 3)."""

    name: str
    material: str
    vertices_m: Array
    faces: NDArray[np.int64]


def _hulls(link: str) -> dict[str, Manifold]:
    solids = parts.convex_parts()[kinematics.LINK_NAMES.index(link)]
    return {part.name: Manifold.hull_points(part.vertices_m) for part in solids}


def _rod(radius: float, half_length: float, at: tuple[float, float, float]) -> Manifold:
    """A cylinder along z about a point, metres."""
    return Manifold.cylinder(2 * half_length, radius, radius, SEGMENTS, True).translate(at)


def _ring(radius: float, z: float) -> Manifold:
    """A seam to cut around a drum of this radius at height z."""
    return _rod(radius + SEAM_M, SEAM_M / 2, (0, 0, z)) - _rod(radius - SEAM_M, 1.0, (0, 0, z))


def _palm() -> dict[str, Manifold]:
    solids = _hulls("palm")
    seams = _ring(parts.PALM_RADIUS_M, -0.048) + _ring(parts.PALM_RADIUS_M, -0.076)
    drum = solids["drum"] - seams
    hub = (0.0, -kinematics.KNUCKLE_LENGTH_M, kinematics.BASE_DEPTH_M)
    width = parts.PROXIMAL_HALF_WIDTH_M + CLEARANCE_M
    slot = _rod(parts.PROXIMAL_HUB_RADIUS_M + CLEARANCE_M, width, (0, 0, 0))
    bracket = solids["bracket"] + solids["bracket_foot"]
    bracket -= slot.rotate((0.0, 90.0, 0.0)).translate(hub)
    pad = solids["plate"].trim_by_plane((0.0, 0.0, 1.0), -PAD_M)
    frame = solids["plate"] + solids["core"] + bracket - pad
    return {"anodised": drum, "aluminium": frame, "rubber": pad}


def _knuckle(link: str, up: float) -> dict[str, Manifold]:
    solids = _hulls(link)
    width = parts.PROXIMAL_HALF_WIDTH_M + CLEARANCE_M
    hub = (kinematics.KNUCKLE_LENGTH_M, 0.0, 0.0)
    slot = _rod(parts.PROXIMAL_HUB_RADIUS_M + CLEARANCE_M, width, (0, 0, 0))
    slot = slot.rotate((90.0, 0.0, 0.0)).translate(hub)
    pivot = _rod(0.007, 0.0005, (0.0, 0.0, up * parts.KNUCKLE_TOP_M))
    return {"anodised": solids["arm"] + solids["lug"] - slot, "aluminium": pivot}


def _pin(radius: float, half_length: float, x: float) -> Manifold:
    return _rod(radius, half_length, (x, 0.0, 0.0))


def _proximal() -> dict[str, Manifold]:
    beam = _hulls("proximal_1")["beam"]
    width = parts.PROXIMAL_HALF_WIDTH_M
    pin = _pin(0.005, parts.KNUCKLE_HALF_WIDTH_M + SEAM_M / 3, 0.0)
    slope = (parts.PROXIMAL_HUB_RADIUS_M - parts.PROXIMAL_END_RADIUS_M) / 0.070
    pad = beam.trim_by_plane((slope, 1.0, 0.0), parts.PROXIMAL_HUB_RADIUS_M - PAD_M)
    pad = pad.trim_by_plane((1.0, 0.0, 0.0), 0.016).trim_by_plane((-1.0, 0.0, 0.0), -0.060)
    relief = Manifold.cube((0.040, 0.010, 0.002), True)
    reliefs = relief.translate((0.036, -0.001, width)) + relief.translate((0.036, -0.001, -width))
    return {"aluminium": beam - pad - reliefs + pin, "rubber": pad}


def _distal() -> dict[str, Manifold]:
    tip = _hulls("distal_1")["fingertip"]
    width = parts.PROXIMAL_HALF_WIDTH_M + CLEARANCE_M
    fork = _rod(parts.DISTAL_TAIL_M * -1 + CLEARANCE_M, width, (0.0, 0.0, 0.0))
    pin = _pin(0.004, parts.DISTAL_FORK_HALF_WIDTH_M + SEAM_M / 3, 0.0)
    pad = tip.trim_by_plane((0.30, 1.0, 0.0), 0.0175).trim_by_plane((1.0, 0.0, 0.0), 0.020)
    return {"anodised": tip - fork - pad, "aluminium": pin, "rubber": pad}


@cache
def link_visuals() -> tuple[tuple[Visual, ...], ...]:
    """Visual solids of each link, in the order of `kinematics.LINK_NAMES`; fingers share them."""
    links = (
        ("palm", _palm()),
        ("knuckle_1", _knuckle("knuckle_1", -1.0)),
        ("knuckle_2", _knuckle("knuckle_2", 1.0)),
        *[("proximal", _proximal())] * 3,
        *[("distal", _distal())] * 3,
    )
    return tuple(
        tuple(_visual(f"{name}_{material}", material, solid) for material, solid in solids.items())
        for name, solids in links
    )


def _visual(name: str, material: str, solid: Manifold) -> Visual:
    mesh = solid.simplify(1e-5).to_mesh64()
    return Visual(name, material, mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64))
