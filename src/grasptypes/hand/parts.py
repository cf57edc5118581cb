"""Convex parts of the BarrettHand's links, built from dimensions, in each link's own frame.

Dimensions are those of GraspIt!'s link meshes (length x height x width: knuckle 76 x 47 x 25,
proximal 92 x 27 x 19, distal 67.5 x 20 x 23 mm; palm x -44.5..44.5, y -64.4..44.5,
z -82.9..12.8 mm). They fit together: 76 = 12.5 + 50 + 13.5 and 92 = 13.5 + 70 + 8.5 are hub radii
around joint distances. The README of the asset derives the rest step by step.
"""

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import manifold3d
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import ConvexHull

from grasptypes.hand import kinematics

Array = NDArray[np.float64]

HUB_SEGMENTS = 16
BODY_SEGMENTS = 32

PALM_RADIUS_M = 0.0445
PALM_BOTTOM_M = -0.0829
PALM_PLATE_BOTTOM_M = -0.010
# Half length of the plate at each height: its ends slope like a finger folded to 140 degrees.
PALM_PLATE_ENDS_M = ((0.0, 0.027), (-0.0075, 0.036), (PALM_PLATE_BOTTOM_M, 0.036))
PALM_CORE_TOP_M = -0.009
PALM_DRUM_TOP_M = -0.036
BRACKET_HALF_WIDTH_M = 0.012
BRACKET_END_M = -0.0644
BRACKET_HUB_RADIUS_M = 0.0138
KNUCKLE_HALF_WIDTH_M = 0.0125
KNUCKLE_BOTTOM_M = -0.0335
KNUCKLE_TOP_M = -0.0095
PROXIMAL_HUB_RADIUS_M = 0.0135
PROXIMAL_END_RADIUS_M = 0.0085
PROXIMAL_HALF_WIDTH_M = 0.0095
DISTAL_HUB_RADIUS_M = 0.010
DISTAL_TAIL_M = -0.0125
DISTAL_FORK_HALF_WIDTH_M = 0.0115
DISTAL_TIP_HALF_WIDTH_M = 0.009
DISTAL_TIP_RADIUS_M = 0.006
DISTAL_PAD_END_M = 0.042
EDGE_M = 0.002


class ConvexPart(NamedTuple):
    """A named convex solid in the frame of its link: corners (n, 3) metres, triangles (m, 3)."""

    name: str
    vertices_m: Array
    faces: NDArray[np.int64]


def circle(x: float, y: float, radius: float, segments: int) -> Array:
    """Corners (segments, 2) of a regular polygon inscribed in a circle, the first at +x."""
    angle = np.arange(segments) * (2 * np.pi / segments)
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle)], axis=1)


def outline(*pieces: ArrayLike) -> Array:
    """The convex outline (n, 2), counter-clockwise, of several sets of points (m, 2)."""
    points = np.concatenate([np.atleast_2d(np.asarray(piece, dtype=float)) for piece in pieces])
    return np.asarray(points[ConvexHull(points).vertices])


def prism(profile: Array, low: float, high: float, edge: float = EDGE_M) -> Array:
    """Corners (n, 3) of a profile (m, 2) extruded along z, its edges chamfered, all metres."""
    section = manifold3d.CrossSection([profile])
    inset = np.concatenate(section.offset(-edge, manifold3d.JoinType.Miter).to_polygons())
    layers = [(inset, low), (profile, low + edge), (profile, high - edge), (inset, high)]
    return np.concatenate([np.column_stack([xy, np.full(len(xy), z)]) for xy, z in layers])


def _on_side(points: Array) -> Array:
    """Stand an (x, height, width) prism up so that its height points along z, y its width."""
    return points[:, [0, 2, 1]] * [1.0, -1.0, 1.0]


def _plate() -> Array:
    heights, half_lengths = np.array(PALM_PLATE_ENDS_M).T
    layers = []
    for height in sorted({*heights, heights[0] - EDGE_M}):
        radius = PALM_RADIUS_M - (EDGE_M if height == heights[0] else 0.0)
        half = np.interp(-height, -heights, half_lengths)
        body = manifold3d.CrossSection([circle(0, 0, radius, BODY_SEGMENTS)])
        cut = body ^ manifold3d.CrossSection.square((1.0, 2 * half), True)
        corners = cut.to_polygons()[0]
        layers.append(np.column_stack([corners, np.full(len(corners), height)]))
    return np.concatenate(layers)


def _palm() -> dict[str, Array]:
    drum = prism(circle(0, 0, PALM_RADIUS_M, BODY_SEGMENTS), PALM_BOTTOM_M, PALM_DRUM_TOP_M)
    width, z = BRACKET_HALF_WIDTH_M, kinematics.BASE_DEPTH_M
    low, half = PALM_DRUM_TOP_M - 0.004, PALM_PLATE_ENDS_M[-1][1]
    core = outline(
        [[side * PALM_RADIUS_M, height] for side in (-1, 1) for height in (low, -0.016)],
        [[-half, PALM_CORE_TOP_M], [half, PALM_CORE_TOP_M]],
    )
    hub = circle(-kinematics.KNUCKLE_LENGTH_M, z, BRACKET_HUB_RADIUS_M, HUB_SEGMENTS)
    foot = outline(
        [[BRACKET_END_M, -0.045], [BRACKET_END_M, z - 0.0185], [-0.050, z - 0.0145]],
        [[-0.036, z - 0.0115], [-0.036, PALM_DRUM_TOP_M - 0.030], [-0.044, PALM_DRUM_TOP_M - 0.03]],
    )
    sideways = [2, 0, 1]  # a (y, z) profile extruded along x
    return {
        "drum": drum,
        "core": prism(core, -width, width)[:, sideways],
        "plate": _plate(),
        "bracket": prism(hub, -width, width)[:, sideways],
        "bracket_foot": prism(foot, -width, width)[:, sideways],
    }


def _knuckle(up: float) -> dict[str, Array]:
    """Parts of a spreading finger's knuckle; `up` is +1 where its z axis is the palm's normal."""
    reach, width = kinematics.KNUCKLE_LENGTH_M, KNUCKLE_HALF_WIDTH_M
    hub = PROXIMAL_HUB_RADIUS_M
    foot = outline(
        [[0.0, KNUCKLE_BOTTOM_M], [reach + hub, KNUCKLE_BOTTOM_M]],
        [[reach + hub, KNUCKLE_TOP_M - 0.0082], [reach - hub, KNUCKLE_TOP_M], [0.0, KNUCKLE_TOP_M]],
    )
    pivot = prism(circle(0, 0, width, BODY_SEGMENTS), KNUCKLE_BOTTOM_M, KNUCKLE_TOP_M)
    arm = _on_side(prism(foot, -width, width))
    lug = _on_side(prism(circle(reach, 0, hub, HUB_SEGMENTS), -width, width))
    turn = np.array([1.0, up, up])
    return {
        "arm": np.concatenate([pivot, arm[arm[:, 0] > EDGE_M]]) * turn,
        "lug": lug * turn,
    }


def _proximal() -> dict[str, Array]:
    near = circle(0, 0, PROXIMAL_HUB_RADIUS_M, HUB_SEGMENTS)
    far = circle(kinematics.PROXIMAL_LENGTH_M, 0, PROXIMAL_END_RADIUS_M, HUB_SEGMENTS)
    width = PROXIMAL_HALF_WIDTH_M
    return {"beam": prism(outline(near, far), -width, width)}


def _distal() -> dict[str, Array]:
    hub = circle(0, 0, DISTAL_HUB_RADIUS_M, HUB_SEGMENTS)
    tail = [[DISTAL_TAIL_M, -0.005], [DISTAL_TAIL_M, 0.005]]
    centre = kinematics.DISTAL_LENGTH_M - DISTAL_TIP_RADIUS_M
    tip = circle(centre, 0, DISTAL_TIP_RADIUS_M, HUB_SEGMENTS)
    pad = [[0.010, DISTAL_HUB_RADIUS_M], [DISTAL_PAD_END_M, DISTAL_HUB_RADIUS_M - EDGE_M]]
    fork = prism(outline(hub, tail), -DISTAL_FORK_HALF_WIDTH_M, DISTAL_FORK_HALF_WIDTH_M)
    nail = prism(outline(pad, tip), -DISTAL_TIP_HALF_WIDTH_M, DISTAL_TIP_HALF_WIDTH_M)
    return {"fingertip": np.concatenate([fork, nail])}


@cache
def convex_parts() -> tuple[tuple[ConvexPart, ...], ...]:
    """The convex parts of every link, in the order of `kinematics.LINK_NAMES`.

    Each part's corners (n, 3) are metres in its link's frame, and all of them lie on its hull.
    """
    links: Sequence[dict[str, Array]] = (
        _palm(),
        _knuckle(-1.0),
        _knuckle(1.0),
        *[_proximal()] * 3,
        *[_distal()] * 3,
    )
    return tuple(tuple(_hull(name, points) for name, points in link.items()) for link in links)


def _hull(name: str, points: Array) -> ConvexPart:
    solid = manifold3d.Manifold.hull_points(np.unique(np.round(points, 6), axis=0))
    mesh = solid.to_mesh64()
    return ConvexPart(name, mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64))
