"""The 19 objects of ContactGrasp (Brahmbhatt et al. 2019) by name."""

from __future__ import annotations

from grasptypes.errors import InputError
from grasptypes.kinds.description import KindPart, MeasuredObject
from grasptypes.kinds.modelling import build_parts
from grasptypes.objects.part_roles import CATALOGUE, read_catalogue
from grasptypes.objects.parts import Material, ObjectModel
from grasptypes.settings.base import MisplacedError


def build(name: str) -> ObjectModel:
    """Build an object as `catalogue.yaml` describes it.

    Raises:
        InputError: the description has a mistake.
    """
    described = MeasuredObject.check(read_catalogue()[name], CATALOGUE)

    def look(_: str, part: KindPart) -> tuple[Material, float | None]:
        """The material of a part, and its density if it is not the object's."""
        given = described.materials[part.material]
        colour = given.base_color
        rgba = (colour[0], colour[1], colour[2], colour[3])
        return Material(rgba, given.metallic, given.roughness), given.density_kg_m3

    try:
        parts = build_parts(described, {}, look)
    except MisplacedError as error:
        raise InputError(CATALOGUE, f"{name}.{error.key}", str(error)) from error
    return ObjectModel(parts, described.density_kg_m3, described.shell_thickness_m)


def object_names() -> list[str]:
    """The names of all objects."""
    return list(read_catalogue())
