"""Sections `objects` and `tasks`: what is grasped, and what for."""

from __future__ import annotations

import re
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from grasptypes.settings.base import MisplacedError, Name, Pair, Settings, Share, Unique, setting
from grasptypes.settings.roles import PartRole

CATALOGUE = (
    "apple", "banana", "bowl", "cell_phone", "cup", "flashlight", "hammer", "knife", "light_bulb",
    "mouse", "mug", "pan", "scissors", "stapler", "toothbrush", "toothpaste", "utah_teapot",
    "water_bottle", "wine_glass",
)  # fmt: skip

Factor = Annotated[float, Field(ge=0.2, le=5)]
Shift = Annotated[float, Field(ge=-0.2, le=0.2)]
Growth = Annotated[float, Field(ge=-0.5, le=0.5)]


def _upwards(values: tuple[float, float]) -> tuple[float, float]:
    low, high = values
    if low > high:
        raise ValueError(f"{low:g} is above {high:g}: give the smaller one first")
    return values


def _of_catalogue(name: str) -> str:
    if name not in CATALOGUE:
        raise ValueError(f"'{name}' is not in the catalogue; allowed: {', '.join(CATALOGUE)}")
    return name


def _is_no_variant(name: str) -> str:
    if re.search(r"_v[0-9][0-9]$", name):
        raise ValueError(f"'{name}' ends like a catalogue variant: choose another name")
    return name


class VariationRanges(Settings):
    """Ranges to draw variants from; smallest and largest value of each."""

    size: Annotated[Pair[Factor], AfterValidator(_upwards)] = setting("factor on everything")
    stretch: Annotated[Pair[Factor], AfterValidator(_upwards)] = setting("factor along each axis")
    balance: Annotated[Pair[Shift], AfterValidator(_upwards)] = setting(
        "share of the extent by which the middle moves"
    )
    taper: Annotated[Pair[Growth], AfterValidator(_upwards)] = setting(
        "share by which the upper end's section grows"
    )


class OwnObject(Settings):
    """A user's own mesh, with either a density or a mass."""

    file: str = setting("STL, OBJ, PLY or GLB of the object")
    unit: Literal["m", "cm", "mm", "inch"] = setting("length unit of the file")
    scale: float = setting("size relative to the file", default=1.0, gt=0)
    density_kg_m3: float | None = setting("density of the material", default=None, gt=0)
    mass_kg: float | None = setting("mass of the object", default=None, gt=0)
    shell_thickness_m: float | None = setting(
        "wall thickness of a hollow object whose mesh is the outside", default=None, gt=0
    )
    parts: dict[str, PartRole] = setting(
        "role of each named part; a mesh without named parts is one part, body", default={}
    )
    contact_maps: dict[str, str] = setting(
        "PLY contact map for each task (red channel, 0 is unseen)", default={}
    )

    @model_validator(mode="after")
    def _weighs_once(self) -> Self:
        if (self.density_kg_m3 is None) == (self.mass_kg is None):
            raise ValueError("needs exactly one of density_kg_m3 and mass_kg")
        return self


class Resolution(Settings):
    """How finely the files follow the models."""

    surface_tolerance_m: float = setting("how far a surface may be simplified", ge=0, le=0.001)
    surface_edge_m: float = setting("longest edge of the evenly meshed surface", ge=0.0005, le=0.02)
    crease_deg: float = setting("edges sharper than this are shaded as edges", ge=1, le=180)
    grid_spacing_m: float = setting(
        "distance between nodes of the distance grid", ge=0.0005, le=0.01
    )
    grid_margin_m: float = setting(
        "how far the distance grid reaches beyond the object", ge=0.002, le=0.2
    )
    grid_capped: bool = setting(
        "whether distances beyond the margin are only bounded, as those of your own meshes are",
        default=False,
    )
    collision_max_parts: int = setting("maximum number of convex parts per object", ge=1, le=512)
    collision_max_gap_m: float = setting(
        "largest mean thickness of the empty space inside hulls", ge=0, le=0.05
    )
    collision_tolerance_m: float = setting(
        "tolerance when simplifying collision parts", ge=0, le=0.005
    )
    collision_max_vertices: int = setting(
        "maximum number of vertices of a convex part", ge=8, le=4096
    )


class ImportLimits(Settings):
    """Requirements on a user's own mesh."""

    min_size_m: float = setting("smallest allowed longest extent", gt=0)
    max_size_m: float = setting("largest allowed longest extent", gt=0)
    max_box_m3: float = setting("largest allowed volume of the bounding box", gt=0)
    max_grid_nodes: int = setting(
        "nodes of the distance grid; a larger one gets a wider spacing", ge=1000
    )
    rebuild_cells: int = setting("cells along the longest extent of a rebuilt mesh", ge=16, le=512)
    colour_cells: int = setting(
        "colours are sampled at this many points along the longest extent", ge=16, le=512
    )
    max_open_share: Share = setting("share of enclosed space of uncertain winding number")
    max_faces: int = setting("maximum number of faces of a mesh", ge=4)
    max_file_mb: float = setting("largest size of a mesh file", gt=0)
    min_volume_share: Share = setting("smallest volume divided by the cube of the longest extent")


class ComparisonSettings(Settings):
    """Samples of the comparison with reference meshes."""

    surface_samples: int = setting("points sampled on each surface", ge=100)
    volume_samples: int = setting("points sampled in the joint bounding box", ge=1000)


class ObjectSettings(Settings):
    """The objects, and how finely their files follow them."""

    names: Unique[Annotated[str, AfterValidator(_of_catalogue)]] = setting(
        "objects from the catalogue"
    )
    scale: float = setting("size relative to ContactDB", gt=0, le=10)
    variants: int = setting(
        "number of variants of each catalogue object in other sizes and proportions", ge=0, le=99
    )
    variation: VariationRanges
    variant_views: int = setting("images of a variant", ge=1)
    own: dict[Annotated[Name, AfterValidator(_is_no_variant)], OwnObject] = setting(
        "a user's own objects by name"
    )
    resolution: Resolution
    import_: ImportLimits = Field(alias="import")
    comparison: ComparisonSettings

    @model_validator(mode="after")
    def _names_apart(self) -> Self:
        if not self.names and not self.own:
            raise MisplacedError("names", "is empty, and so is objects.own: name an object")
        for name in self.own:
            if name in self.names:
                raise MisplacedError(f"own.{name}", "is also in objects.names: choose another name")
        return self


class TaskSettings(Settings):
    """What the object is grasped for."""

    colour_shift: int = setting("added to each RGB value, levels of 255", ge=-255, le=255)
