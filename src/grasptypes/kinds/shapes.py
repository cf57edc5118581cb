"""Solids of a kind from their evaluated descriptions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from manifold3d import CrossSection, FillRule, JoinType, Manifold, OpType
from numpy.typing import NDArray

from grasptypes.kinds import lofts, sections, solid_description
from grasptypes.kinds.curves import curve, furrow_factors, outline, round_samples
from grasptypes.kinds.sweeps import sweep
from grasptypes.objects import solids
from grasptypes.settings.base import MisplacedError

Array = NDArray[np.float64]
Shapes = Mapping[str, Manifold]

# Rotations in degrees that carry z onto an axis; the plane of an extruded section keeps the names
# of its axes.
_ONTO = {"x": (0.0, 90.0, 0.0), "y": (-90.0, 0.0, 0.0), "z": (0.0, 0.0, 0.0)}
_PLANE_ONTO = {"x": (90.0, 0.0, 90.0), "y": (90.0, 0.0, 0.0), "z": (0.0, 0.0, 0.0)}
COIL_STEPS = 24
# A nanometre: far above rounding, far below anything that is modelled.
ROUNDED_DIGITS = 9


def union(described: Sequence[solid_description.Solid], shapes: Shapes, key: str) -> Manifold:
    """The union of evaluated solids.

    Raises:
        MisplacedError: a solid is empty; names its key.
    """
    built = [build(one, shapes, f"{key}.{number}") for number, one in enumerate(described)]
    return Manifold.batch_boolean(built, OpType.Add) if len(built) > 1 else built[0]


def build(solid: solid_description.Solid, shapes: Shapes, key: str) -> Manifold:
    """One evaluated solid, in the order that :class:`solid_description.Solid` states."""
    name = next(name for name in solid_description.SHAPES if getattr(solid, name) is not None)
    try:
        made = _make(name, solid, shapes, f"{key}.{name}")
    except (ValueError, IndexError) as error:
        if isinstance(error, MisplacedError):
            raise
        raise MisplacedError(f"{key}.{name}", str(error)) from error
    if solid.cut:
        made -= union(solid.cut, shapes, f"{key}.cut")
    for number, one in enumerate(solid.within):
        made ^= build(one, shapes, f"{key}.within.{number}")
    for axis, (low, high) in solid.keep.items():
        made = between(made, axis, low, high)
    made = made.scale(tuple(solid.scale)).rotate(tuple(solid.turn)).translate(tuple(solid.at))
    made = _copies(made, solid)
    if made.is_empty():
        raise MisplacedError(key, "is empty: check its dimensions, cut and keep")
    return made


def between(solid: Manifold, axis: str, low_m: float, high_m: float) -> Manifold:
    """What lies between two positions along an axis."""
    normal = (float(axis == "x"), float(axis == "y"), float(axis == "z"))
    above, _ = solid.split_by_plane(normal, low_m)
    _, inside = above.split_by_plane(normal, high_m)
    # Slices of one solid vanish in their union only if they meet exactly.
    return inside.warp_batch(lambda points: np.round(points, ROUNDED_DIGITS))


def _copies(made: Manifold, solid: solid_description.Solid) -> Manifold:
    if solid.row:
        step = np.asarray(solid.row.step)
        made = _all([made.translate(tuple(step * number)) for number in range(solid.row.count)])
    if solid.ring:
        ring, turn = solid.ring, np.array([float(name == solid.ring.axis) for name in "xyz"])
        whole = abs(ring.angle) >= 360
        share = ring.angle / (ring.count if whole else max(ring.count - 1, 1))
        made = _all([made.rotate(tuple(turn * share * number)) for number in range(ring.count)])
    for axis in solid.mirrored:
        made += made.mirror(tuple(float(name == axis) for name in "xyz"))
    return made


def _all(parts: Sequence[Manifold]) -> Manifold:
    return Manifold.batch_boolean(list(parts), OpType.Add) if len(parts) > 1 else parts[0]


def _make(name: str, solid: solid_description.Solid, shapes: Shapes, key: str) -> Manifold:
    if name == "shape":
        if solid.shape not in shapes:
            known = ", ".join(shapes) or "none"
            raise ValueError(f"there is no shape '{solid.shape}' before it; known: {known}")
        return shapes[str(solid.shape)]
    if name == "group":
        return union(solid.group or (), shapes, key)
    if name == "hull":
        return union(solid.hull or (), shapes, key).hull()
    if name == "ellipsoid":
        half_axes = _above_zero(solid.ellipsoid or ())
        return solids.ellipsoid(half_axes, round_samples(max(half_axes)))
    if name == "box":
        assert solid.box is not None
        size = _above_zero(solid.box.size)
        return solids.box(size, min(solid.box.radius, 0.4999 * min(size)))
    makers = {
        "cylinder": _cylinder, "torus": _torus, "turned": _turned, "extruded": _extruded,
        "swept": sweep, "lofted": _lofted, "coil": _coil, "duct": _duct,
    }  # fmt: skip
    made: Manifold = makers[name](getattr(solid, name))  # type: ignore[operator]
    if name in ("swept", "lofted", "duct"):
        return made
    if name != "extruded":
        return made.rotate(_ONTO[solid.axis])
    turned = made.rotate(_PLANE_ONTO[solid.axis])
    # (x, z) is left-handed when seen along y.
    return turned.mirror((0.0, 1.0, 0.0)) if solid.axis == "y" else turned


def _above_zero(numbers: Sequence[float]) -> tuple[float, ...]:
    if min(numbers) <= 0:
        raise ValueError(f"{min(numbers):g} is not above 0")
    return tuple(numbers)


def _rise(between: Sequence[float]) -> tuple[float, float]:
    low, high = between
    if low >= high:
        raise ValueError(f"between: {low:g} is not below {high:g}")
    return low, high


def _cylinder(given: solid_description.Cylinder) -> Manifold:
    low, high = _rise(given.between)
    top = given.radius if given.top_radius is None else given.top_radius
    made = Manifold.cylinder(high - low, given.radius, top, round_samples(max(given.radius, top)))
    return made.translate((0.0, 0.0, low))


def _torus(given: solid_description.Torus) -> Manifold:
    tube = sections.circle(given.tube_radius, round_samples(given.tube_radius))
    segments = round_samples(given.ring_radius)
    ring = CrossSection([tube + [given.ring_radius, 0.0]], FillRule.NonZero)
    return ring.revolve(segments, min(given.angle, 360.0))


def _turned(given: solid_description.Turned) -> Manifold:
    profile = curve(given.profile, given.smooth)
    if (profile[:, 0] < -1e-9).any():
        raise ValueError(f"the profile reaches a radius of {profile[:, 0].min():g}, below 0")
    closed = sections.chain(profile, [(0.0, profile[-1, 1])], [(0.0, profile[0, 1])])
    figure = CrossSection([closed], FillRule.EvenOdd)
    if given.wall is not None:
        figure -= _hollow(profile, given.wall)
    made = figure.revolve(given.segments)
    return made.warp_batch(_furrows(given.lobes)) if given.lobes else made


def _hollow(profile: Array, wall_m: float) -> CrossSection:
    """What a vessel holds, up to above its open end."""
    over = profile[-1] + [0.0, 3 * wall_m]
    half = np.vstack([profile, over, [0.0, over[1]]])
    mirror = half[::-1] * [-1.0, 1.0]
    whole = CrossSection([np.vstack([half, mirror])], FillRule.NonZero)
    if whole.is_empty():
        whole = CrossSection([np.vstack([half, mirror])[::-1]], FillRule.NonZero)
    return whole.offset(-wall_m, JoinType.Round, 2.0, 32)


def _furrows(lobes: solid_description.Lobes) -> Callable[[Array], Array]:
    """The map of points (N, 3) that presses furrows into a turned body."""

    def warp(points: Array) -> Array:
        """Points (N, 3), moved towards the z axis where there is a furrow."""
        points = np.asarray(points)
        factor = furrow_factors(points, lobes)
        if lobes.fade:
            low, high = points[:, 2].min(), points[:, 2].max()
            factor = 1 - (1 - factor) * np.clip((high - points[:, 2]) / (high - low), 0, 1)
        return np.asarray(points * np.column_stack([factor, factor, np.ones_like(factor)]))

    return warp


def _extruded(given: solid_description.Extruded) -> Manifold:
    low, high = _rise(given.between)
    polygon, bevel = outline(given.section), given.bevel
    if bevel > 0 and not given.holes:
        inset = sections.offset_curve(np.vstack([polygon[-1:], polygon, polygon[:1]]), bevel)[1:-1]
        rings = [(inset, low), (polygon, low + bevel), (polygon, high - bevel), (inset, high)]
        return solids.loft([np.insert(ring, 2, height, axis=1) for ring, height in rings])
    holes = [outline(hole) for hole in given.holes]
    made = solids.extrude(polygon, high - low, holes)
    return made.translate((0.0, 0.0, low))


def _lofted(given: solid_description.Lofted) -> Manifold:
    along, *names = given.columns
    rows = np.asarray(given.rows, dtype=np.float64)
    if (np.diff(rows[:, 0]) <= 0).any():
        raise ValueError(f"rows: {along} does not increase")
    stations, values = lofts.interpolate_stations(rows, given.count)
    column = {name: values[:, number] for number, name in enumerate(names)}
    half, middle = [], []
    for axis in [name for name in "xyz" if name != along]:
        low, high = column.get(f"low_{axis}"), column.get(f"high_{axis}")
        if low is not None and high is not None:
            half.append((high - low) / 2)
            middle.append((high + low) / 2)
            continue
        width = column.get(f"half_{axis}", column.get("radius"))
        if width is None:
            raise ValueError(f"columns: no half_{axis}, radius, or low_{axis} and high_{axis}")
        half.append(width)
        middle.append(column.get(f"mid_{axis}", np.zeros(len(values))))
    exponents = column.get("exponent", np.full(len(values), given.exponent))
    samples = round_samples(float(np.max(half)))
    outlines = [
        _loft_section(given, float(power), samples, (float(first), float(second))) + centre
        for first, second, power, centre in zip(
            *half, exponents, np.column_stack(middle), strict=True
        )
    ]
    return lofts.loft_along(along, stations, outlines)


def _loft_section(
    given: solid_description.Lofted, exponent: float, samples: int, half_m: tuple[float, float]
) -> Array:
    """A section (N, 2), centred on the origin, with the given half widths."""
    if given.section is not None:
        return np.asarray(outline(given.section) * half_m)
    if given.crown is None:
        return lofts.even_superellipse(*half_m, exponent, samples)
    top_m, bottom_m = (min(crown, 0.4 * half_m[1]) for crown in given.crown)
    return lofts.crowned_section(half_m[0], -half_m[1], half_m[1], exponent, top_m, bottom_m)


def _duct(given: solid_description.Duct) -> Manifold:
    rows = sections.smooth_curve(given.rows)
    low, high = sections.in_xz(rows[:, :2]), sections.in_xz(rows[:, 2:4])
    circle, across = sections.circle(1.0, 40), np.outer(rows[:, 4], [0.0, 1.0, 0.0])
    middle, upright = (low + high)[:, None] / 2, (low - high)[:, None] / 2
    return solids.loft(
        middle + circle[None, :, :1] * upright + circle[None, :, 1:] * across[:, None]
    )


def _coil(given: solid_description.Coil) -> Manifold:
    low, high = _rise(given.between)
    top = given.radius if given.top_radius is None else given.top_radius
    count = int(COIL_STEPS * given.turns) + 1
    angle = 2 * np.pi * given.turns * np.linspace(0, 1, count)
    radius = np.linspace(given.radius, top, count)
    path = np.column_stack(
        [radius * np.cos(angle), radius * np.sin(angle), np.linspace(low, high, count)]
    )
    return solids.sweep(path, sections.circle(given.tube_radius, 12), up=(0.0, 0.0, 1.0))
