"""Solids as data: the typed form of what a part of a kind, or of a measured object, is made of.

Lengths are in metres, angles in degrees, counter-clockwise. A number may be an expression of the
kind's dimensions.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Field, PlainValidator, model_validator

from grasptypes.kinds.expressions import parse
from grasptypes.settings.base import Many, MisplacedError, Settings, Unique, setting

Number = Annotated[Any, PlainValidator(parse)]
Numbers = Many[Number]
Vector = Annotated[Numbers, Field(min_length=3, max_length=3)]
Interval = Annotated[Numbers, Field(min_length=2, max_length=2)]
Axis = Literal["x", "y", "z"]


def _point(written: Any) -> tuple[Any, ...]:
    """Coordinates, and for a corner of a curve its radius or the word `smooth`."""
    if not isinstance(written, list | tuple) or not 2 <= len(written) <= 4:
        raise ValueError(f"{written} is not a point: give its coordinates in a list")
    *numbers, last = written
    return (*map(parse, numbers), last if last == "smooth" else parse(last))


Points = Annotated[Many[Annotated[Any, PlainValidator(_point)]], Field(min_length=2)]


def one_of(section: Settings, names: tuple[str, ...]) -> None:
    """Check that exactly one of the keys is given."""
    given = [name for name in names if getattr(section, name) is not None]
    if len(given) != 1:
        said = f"has {' and '.join(given)}" if given else "has no shape"
        raise MisplacedError("", f"{said}: give exactly one of {', '.join(names)}")


class Polygon(Settings):
    """A regular polygon."""

    sides: int = setting("number of corners", ge=3, le=64)
    radius: Number = setting("distance of the corners from the centre")
    inner: Number | None = setting("distance of the corners between them, for a star", default=None)


class Lobes(Settings):
    """Furrows around a round body."""

    count: int = setting("number of furrows around the axis", ge=2, le=90)
    depth: Number = setting("share of the radius that they are deep")
    fade: bool = setting("whether they fade towards the upper end", default=False)


class Section(Settings):
    """A plane figure, centred on the origin of its plane."""

    circle: Number | None = setting("radius", default=None)
    ellipse: Annotated[Numbers, Field(min_length=2, max_length=3)] | None = setting(
        "half axes, and the exponent of a superellipse (2 if left out)", default=None
    )
    rectangle: Annotated[Numbers, Field(min_length=2, max_length=3)] | None = setting(
        "two sides, and the radius of the corners", default=None
    )
    polygon: Polygon | None = None
    outline: Points | None = setting(
        "corners, each with an optional radius or the word smooth", default=None
    )
    smooth: bool = setting("whether the outline is a curve through all its points", default=False)
    lobes: Lobes | None = setting("furrows of a circle", default=None)
    at: Interval = setting("position of the figure's origin", default=(0.0, 0.0))
    turn: Number = setting("angle about the figure's origin", default=0.0)

    @model_validator(mode="after")
    def _one(self) -> Self:
        one_of(self, ("circle", "ellipse", "rectangle", "polygon", "outline"))
        return self


class Box(Settings):
    """A box, its edges rounded."""

    size: Vector = setting("extents along x, y and z")
    radius: Number = setting("radius of the edges", default=0.0)


class Cylinder(Settings):
    """A cylinder or truncated cone around the axis."""

    radius: Number = setting("radius, at the lower end")
    top_radius: Number | None = setting("radius at the upper end, if it differs", default=None)
    between: Interval = setting("lower and upper end along the axis")


class Torus(Settings):
    """A ring around the axis, or an arc of it from x counter-clockwise."""

    ring_radius: Number = setting("from the axis to the middle of the tube")
    tube_radius: Number = setting("of the tube")
    angle: Number = setting("how much of the ring there is", default=360.0)


class Turned(Settings):
    """A profile turned around the axis."""

    profile: Points = setting("rows of radius, height, and optional corner radius or smooth")
    smooth: bool = setting("whether the profile is a curve through all its points", default=False)
    wall: Number | None = setting(
        "thickness of the wall of a vessel, open at the profile's last point", default=None
    )
    lobes: Lobes | None = None
    segments: int = setting("number of segments around the axis", default=72, ge=8, le=256)


class Extruded(Settings):
    """A section drawn along the axis.

    Its plane is (x, y) for the axis z, (x, z) for y, and (y, z) for x.
    """

    section: Section
    holes: Many[Section] = setting("what is left out", default=())
    between: Interval = setting("lower and upper end along the axis")
    bevel: Number = setting("width of the chamfer at both ends; without holes only", default=0.0)


class Swept(Settings):
    """A section carried along a path."""

    path: Points = setting("points x, y, z, each with an optional radius of the bend")
    smooth: bool = setting("whether the path is a curve through all its points", default=True)
    closed: bool = setting("whether the path returns to its start", default=False)
    section: Section
    scales: Many[Numbers] | None = setting(
        "rows of a share of the path and the section's size there", default=None
    )
    up: Vector | None = setting(
        "direction that the section's second axis stays closest to; without it, the section does "
        "not twist",
        default=None,
    )


class Coil(Settings):
    """A helix around the axis."""

    radius: Number = setting("from the axis to the middle of the wire")
    top_radius: Number | None = setting("the same at the upper end, if it differs", default=None)
    tube_radius: Number = setting("of the wire")
    turns: Number = setting("number of turns")
    between: Interval = setting("lower and upper end along the axis")


class Lofted(Settings):
    """Changing sections along x, y or z."""

    columns: Unique[str] = setting("what the rows contain; the first is x, y or z")
    rows: Many[Numbers] = setting("one section each", min_length=2)
    section: Section | None = setting(
        "figure within -1 to 1 instead of a superellipse", default=None
    )
    exponent: Number = setting("of the superellipse, if it is not a column", default=2.0)
    crown: Interval | None = setting(
        "how much lower the top is at the sides than in the middle, and the bottom higher; at most "
        "a fifth of the height",
        default=None,
    )
    count: int = setting("number of sections", default=40, ge=2, le=200)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        along = self.columns[0]
        if along not in ("x", "y", "z"):
            raise MisplacedError("columns", f"begins with '{along}' instead of x, y or z")
        known = {"radius", "exponent"}
        known |= {f"{what}_{a}" for what in ("half", "mid", "low", "high") for a in "xyz"}
        for name in self.columns[1:]:
            if name not in known or name.endswith(f"_{along}"):
                raise MisplacedError("columns", f"'{name}' is none of {', '.join(sorted(known))}")
        for number, row in enumerate(self.rows):
            if len(row) != len(self.columns):
                said = f"has {len(row)} values for {len(self.columns)} columns"
                raise MisplacedError(f"rows.{number}", said)
        return self


class Duct(Settings):
    """Ellipses between two curves in the plane y = 0, such as a spout."""

    rows: Annotated[
        Many[Annotated[Numbers, Field(min_length=5, max_length=5)]], Field(min_length=2)
    ] = setting("x, z of the one curve, x, z of the other, half width along y; a smooth curve")


class Row(Settings):
    """Copies in a straight line."""

    count: int = setting("number of copies", ge=1, le=200)
    step: Vector = setting("from one copy to the next")


class Ring(Settings):
    """Copies around an axis through the origin."""

    count: int = setting("number of copies", ge=1, le=200)
    axis: Axis = setting("about which they are turned", default="z")
    angle: Number = setting("over which they are spread", default=360.0)


class Solid(Settings):
    """One solid: its shape, what is cut from it, and where it is.

    The order is: shape, `axis`, `cut`, `within`, `keep`, `scale`, `turn`, `at`, `row`, `ring`,
    `mirrored`.
    """

    box: Box | None = None
    ellipsoid: Vector | None = setting("half axes along x, y and z", default=None)
    cylinder: Cylinder | None = None
    torus: Torus | None = None
    turned: Turned | None = None
    extruded: Extruded | None = None
    swept: Swept | None = None
    lofted: Lofted | None = None
    coil: Coil | None = None
    duct: Duct | None = None
    hull: Many[Solid] | None = setting("convex hull of solids", default=None)
    group: Many[Solid] | None = setting("solids that are placed together", default=None)
    shape: str | None = setting("name of one of the kind's shapes", default=None)
    axis: Axis = setting("of a cylinder, torus, coil, turned or extruded solid", default="z")
    cut: Many[Solid] = setting("solids that are taken away", default=())
    within: Many[Solid] = setting("solids outside which nothing is kept", default=())
    keep: dict[Axis, Interval] = setting("range along an axis that is kept", default={})
    scale: Vector = setting("factors along x, y and z", default=(1.0, 1.0, 1.0))
    turn: Vector = setting("angles about x, then y, then z", default=(0.0, 0.0, 0.0))
    at: Vector = setting("position of the solid's origin", default=(0.0, 0.0, 0.0))
    row: Row | None = None
    ring: Ring | None = None
    mirrored: Unique[Axis] = setting("axes along which a mirror image is added", default=())

    @model_validator(mode="after")
    def _one(self) -> Self:
        one_of(self, SHAPES)
        return self


SHAPES = (
    "box", "ellipsoid", "cylinder", "torus", "turned", "extruded", "swept", "lofted", "coil",
    "duct", "hull", "group", "shape",
)  # fmt: skip


Solids = Annotated[Many[Solid], Field(min_length=1)]
