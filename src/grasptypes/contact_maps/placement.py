"""A person's hand and where it is put for a hold: centre, side of the palm, closing direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from grasptypes.contact_maps.hold import Hold
from grasptypes.settings.contact_maps import HandProportions, PlacementSettings

Array = NDArray[np.float64]


@dataclass(frozen=True)
class HumanHand:
    """A hand's size (metres); the fields of `proportions` are keys of params.yaml.

    Attributes:
        length_m: wrist to the tip of the middle finger.
        breadth_m: across the bases of the four fingers.
        finger_reach_m: along the surface from the palm's centre to a fingertip.
        thumb_reach_m: the same to the thumb's tip.
        palm_half_m: half of the touching palm, across the handle.
        palm_radius_m: radius of the palm's patch when the fingers are spread.
        finger_half_width_m: half the breadth of a finger.
        pad_radius_m: radius of a fingertip's patch.
        span_m: maximum distance of a fingertip from the centre of a precision grip.
        softness_m: depth by which skin gives way.
    """

    length_m: float
    breadth_m: float
    finger_reach_m: float
    thumb_reach_m: float
    palm_half_m: float
    palm_radius_m: float
    finger_half_width_m: float
    pad_radius_m: float
    span_m: float
    softness_m: float

    @classmethod
    def of_length(cls, length_m: float, proportions: HandProportions) -> HumanHand:
        """A hand from its length and lengths relative to it, without the suffix `_m`."""
        lengths = {f"{key}_m": share * length_m for key, share in proportions}
        return cls(length_m, **lengths)

    def finger_offsets_m(self, count: int = 4) -> Array:
        """(count,) positions of `count` neighbouring fingers side by side, centred on zero."""
        return (np.arange(count) - (count - 1) / 2) * self.breadth_m / 4


@dataclass(frozen=True)
class Placement:
    """Pose of the hand (object frame, metres; directions are orthogonal unit vectors).

    Attributes:
        centre_m: (3,) between palm, fingers and thumb.
        palm_side: (3,) from the centre to the palm.
        axis: (3,) along which the fingers are side by side.
        closing: (3,) from the thumb to the fingers.
        fingers: number of fingers that touch in a precision grip, 2 to 4.
    """

    centre_m: Array
    palm_side: Array
    axis: Array
    closing: Array
    fingers: int = 4


@dataclass(frozen=True)
class SurfacePoints:
    """Points (N, 3) m on an object's surface, their normals (N, 3) and part indices (N,)."""

    points_m: Array
    normals: Array
    part_index: NDArray[np.int16]


@dataclass(frozen=True)
class HeldSurface:
    """Points (N, 3) in metres, outward unit normals (N, 3) and which points the hand may touch."""

    points_m: Array
    normals: Array
    mask: NDArray[np.bool_]


def place_hand(
    surface: HeldSurface,
    hold: Hold,
    hand: HumanHand,
    settings: PlacementSettings,
    draw: np.random.Generator,
) -> tuple[Placement, float]:
    """Place a hand on the held parts according to a hold, with a person's random deviation.

    Args:
        surface: surface of the object, with a mask of the held parts.

    Returns:
        The placement and the height (0 to 1) of its centre along the held parts.
    """
    held = surface.points_m[surface.mask]
    long_axis = _longest_axis(held) if hold.axis is None else hold.axis
    height = float(draw.uniform(hold.low, hold.high))
    centre_m = _centre(held, long_axis, height, settings.slice_m)
    palm_side = _palm_side(hold, long_axis, settings.tilt_sd_rad, draw)
    axis = long_axis - (long_axis @ palm_side) * palm_side
    end_on = np.linalg.norm(axis) < 0.5
    if end_on:
        axis = _any_normal(palm_side)
    axis /= np.linalg.norm(axis)
    if hold.grip == "rim":
        centre_m, axis = _rim_centre(held, palm_side, settings.depth_m, draw)
    roll = draw.uniform(0, 2 * np.pi) if end_on else draw.normal(0.0, settings.roll_sd_rad)
    if hold.grip != "rim":
        axis = np.cos(roll) * axis + np.sin(roll) * np.cross(palm_side, axis)
    # Left or right hand, and the thumb at either end.
    axis = axis * draw.choice([-1.0, 1.0])
    closing = np.cross(palm_side, axis) * draw.choice([-1.0, 1.0])
    fingers = int(draw.integers(2, 5))
    return Placement(centre_m, palm_side, axis, closing, fingers), height


def _longest_axis(held: Array) -> Array:
    """The direction (3,) in which the held points (N, 3) extend most."""
    axis = np.linalg.svd(held - held.mean(axis=0), full_matrices=False)[2][0]
    return np.asarray(axis * np.sign(axis[np.argmax(np.abs(axis))]))


def _centre(held: Array, axis: Array, height: float, slice_m: float) -> Array:
    """Middle of a slice at a given height: halfway between its extremes, so holes do not matter."""
    along = held @ axis
    low, high = along.min(), along.max()
    at = low + height * (high - low)
    thickness_m = max(slice_m, 1.01 * np.abs(along - at).min())
    cut = held[np.abs(along - at) <= thickness_m]
    aside = cut - np.outer(cut @ axis, axis)
    return np.asarray((aside.min(axis=0) + aside.max(axis=0)) / 2 + at * axis)


def _palm_side(hold: Hold, long_axis: Array, tilt_sd: float, draw: np.random.Generator) -> Array:
    if hold.sides is None:
        side = draw.normal(size=3)
        side -= (side @ long_axis) * long_axis
        side /= np.linalg.norm(side)
    else:
        side = hold.sides[draw.integers(len(hold.sides))]
    tilted = side + draw.normal(0.0, tilt_sd, 3)
    if hold.grip in ("wrap", "pinch"):
        # Fingers side by side along the axis close around it, so the palm is beside it.
        flat = tilted - (tilted @ long_axis) * long_axis
        if np.linalg.norm(flat) > 0.3:
            tilted = flat
    return tilted / np.linalg.norm(tilted)


def _rim_centre(
    held: Array, palm_side: Array, depth_m: float, draw: np.random.Generator
) -> tuple[Array, Array]:
    """A point `depth_m` below the edge that faces the palm, and the direction of the edge."""
    middle = (held.min(axis=0) + held.max(axis=0)) / 2
    outward = _any_normal(palm_side)
    angle = draw.uniform(0, 2 * np.pi)
    outward = np.cos(angle) * outward + np.sin(angle) * np.cross(palm_side, outward)
    along = np.cross(palm_side, outward)
    offset = held - middle
    sector = (offset @ outward > 0) & (np.abs(offset @ along) < 0.25 * np.abs(offset).max())
    near = held[sector] if sector.any() else held
    height = near @ palm_side
    edge = near[height > height.max() - depth_m]
    lowest = near[np.abs(height - (height.max() - depth_m)) < 0.5 * depth_m]
    base = lowest if len(lowest) else edge
    centre = base.mean(axis=0)
    return centre + (height.max() - depth_m - centre @ palm_side) * palm_side, along


def _any_normal(direction: Array) -> Array:
    """A unit vector orthogonal to a direction; deterministic."""
    other = np.eye(3)[np.argmin(np.abs(direction))]
    normal = np.cross(direction, other)
    return np.asarray(normal / np.linalg.norm(normal))
