"""What a kind of object is made of: the typed form of a block in `data/<group>.yaml`."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from grasptypes.kinds.solid_description import Number, Solid, Solids
from grasptypes.settings.base import Many, MisplacedError, Name, Settings, Share, Unique, setting
from grasptypes.settings.roles import PartRole


class KindPart(PartRole):
    """A part: what it is for, what it is made of, and its solids."""

    material: str = setting("one of the materials in materials.yaml")
    colour: Unique[str] | str | None = setting(
        "of materials.yaml or of the kind, or several to choose from", default=None
    )
    solids: Solids
    cut: Many[Solid] = setting("solids that are taken away, in the object's frame", default=())


def _range(written: Any) -> Any:
    """`[low, high, source]` as a mapping."""
    if isinstance(written, list | tuple):
        if len(written) != 3:
            raise ValueError(f"{written} is not [lowest, highest, source]")
        return dict(zip(("low", "high", "source"), written, strict=True))
    return written


class Range(Settings):
    """Values that occur, and where they come from."""

    low: float = setting("smallest value")
    high: float = setting("largest value")
    source: str = setting("where the range comes from", min_length=1)

    @model_validator(mode="after")
    def _upwards(self) -> Self:
        if self.low > self.high:
            raise MisplacedError(
                "", f"{self.low:g} is above {self.high:g}: give the smaller one first"
            )
        return self


FromList = BeforeValidator(_range)


def _positive(given: Range) -> Range:
    if given.low <= 0:
        raise ValueError(f"{given.low:g} is not above 0")
    return given


class Blueprint(Settings):
    """The parts of an object."""

    shell_thickness_m: float | None = setting(
        "wall thickness if the object is hollow and its solids are filled", default=None, gt=0
    )
    derived: dict[Name, Number] = setting("dimensions that follow from others", default={})
    shapes: dict[Name, Solids] = setting("solids that parts refer to", default={})
    parts: dict[Name, KindPart] = setting(
        "parts; the first of two that overlap owns what they share", min_length=1
    )


class Kind(Blueprint):
    """A kind of object that people pick up with one hand."""

    imagenet: Unique[str] = setting("classes of ImageNet (ILSVRC 2012) that it corresponds to")
    ycb: Unique[str] = setting("YCB objects of this kind", default=())
    furniture: Unique[str] = setting("items of Sweet Home 3D of this kind", default=())
    taskgrasp: Unique[str] = setting("TaskGrasp objects of this kind", default=())
    family: Name = setting("kinds of one family are held out together")
    mass_kg: Annotated[Range, AfterValidator(_positive), FromList]
    sizes: dict[Name, Annotated[Range, FromList]] = setting("dimensions that differ between shapes")
    colours: dict[Name, Unique[str]] = setting("colours that several parts share", default={})


class Look(Settings):
    """A material of a measured object, in glTF's metallic-roughness model."""

    base_color: Annotated[Many[Share], Field(min_length=4, max_length=4)] = setting(
        "sRGB and opacity"
    )
    metallic: Share = setting("0 for plastic, wood and glass, 1 for bare metal", default=0.0)
    roughness: Share = setting("0 mirror-like, 1 matt", default=0.6)
    density_kg_m3: float | None = setting("density, if it is not the object's", default=None, gt=0)


class MeasuredObject(Blueprint):
    """One object in the size and frame in which it was measured."""

    density_kg_m3: float = setting("of the walls (with a shell thickness) or of the solid", gt=0)
    materials: dict[Name, Look] = setting("materials by name")


class Surface(Settings):
    """A material in glTF's metallic-roughness model."""

    density_kg_m3: float = setting("density", gt=0)
    colour: str = setting("colour, if the part gives none")
    metallic: Share = setting("0 for plastic, wood and glass, 1 for bare metal", default=0.0)
    roughness: Share = setting("0 mirror-like, 1 matt", default=0.6)
    opacity: Share = setting("1 is opaque", default=1.0)


class Materials(Settings):
    """The file `materials.yaml`."""

    materials: dict[Name, Surface]
    colours: dict[Name, Annotated[Many[Share], Field(min_length=3, max_length=3)]]
