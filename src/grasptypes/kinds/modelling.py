"""Object models of kinds: dimensions and colours are drawn, expressions evaluated, solids built."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from manifold3d import Manifold
from pydantic import BaseModel

from grasptypes.errors import InputError
from grasptypes.kinds import library, shapes
from grasptypes.kinds.description import Blueprint, Kind, KindPart, Materials, Range
from grasptypes.kinds.expressions import Expression
from grasptypes.kinds.names import DATA, MATERIALS, kind_names, shape_of
from grasptypes.objects import solids
from grasptypes.objects.parts import ImportedModel, Material, ObjectModel, Part
from grasptypes.seeds import rng
from grasptypes.settings.base import MisplacedError
from grasptypes.settings.roles import PartRole


@dataclass(frozen=True)
class Draw:
    """What makes one shape of a kind differ from the others.

    Attributes:
        shares: position of each dimension in its range, 0 to 1.
        colours: position in each list of colours, 0 to 1, by the name of the list or part.
    """

    shares: Mapping[str, float]
    colours: Mapping[str, float]

    @classmethod
    def extreme(cls, kind: Kind, share: float) -> Draw:
        """All dimensions at the same position of their ranges; the first colours."""
        return cls(dict.fromkeys(kind.sizes, share), {})


def draw_shape(kind: Kind, name: str, number: int) -> Draw:
    """The draw of a shape; each dimension and colour has a seed of its own."""
    return Draw(
        {size: float(rng("kind", name, number, size).random()) for size in kind.sizes},
        {
            key: float(rng("kind colour", name, number, key).random())
            for key in (*kind.colours, *kind.parts)
        },
    )


def dimensions(kind: Kind, draw: Draw) -> dict[str, float]:
    """The values of all dimensions.

    Raises:
        MisplacedError: a derived dimension cannot be computed; names its key.
    """
    drawn = {name: at_share(size, draw.shares[name]) for name, size in kind.sizes.items()}
    return _all_dimensions(kind, drawn)


def _all_dimensions(blueprint: Blueprint, drawn: Mapping[str, float]) -> dict[str, float]:
    """Dimensions that were drawn, and those that follow from them."""
    values = dict(drawn)
    for name, number in blueprint.derived.items():
        values[name] = _evaluated(number, values, f"derived.{name}")
    return values


def at_share(given: Range, share: float) -> float:
    """The value at a share of a range."""
    return given.low + (given.high - given.low) * share


def build_shape(name: str, folder: Path = DATA) -> ImportedModel:
    """The model of a shape by name, such as mallet_s01; the same one for the same name.

    Raises:
        InputError: there is no such kind, or it has a mistake.
    """
    kind_name, number = shape_of(name)
    kind = library.read_kind(kind_name, folder)
    return build_kind(kind_name, draw_shape(kind, kind_name, number), folder)


def build_kind(name: str, draw: Draw, folder: Path = DATA) -> ImportedModel:
    """The model of a kind for given dimensions.

    Its mass has the position in the range of masses that its volume has between those of the
    smallest and the largest shape.

    Raises:
        InputError: there is no such kind, or it has a mistake.
    """
    model = _checked_model(name, draw, folder)
    low_m3, high_m3 = extreme_volumes(name, folder)
    share = (_volume(model) - low_m3) / (high_m3 - low_m3) if high_m3 > low_m3 else 0.5
    mass_kg = at_share(library.read_kind(name, folder).mass_kg, float(np.clip(share, 0, 1)))
    return ImportedModel(model, 1.0, mass_kg)


@cache
def extreme_volumes(name: str, folder: Path = DATA) -> tuple[float, float]:
    """Volumes (m3) of a kind's smallest and largest shape."""
    kind = library.read_kind(name, folder)
    low, high = (_checked_model(name, Draw.extreme(kind, share), folder) for share in (0.0, 1.0))
    return _volume(low), _volume(high)


def _volume(model: ObjectModel) -> float:
    return float(solids.union(*(part.solid for part in model.parts)).volume())


def _checked_model(name: str, draw: Draw, folder: Path) -> ObjectModel:
    """The model; raises InputError."""
    try:
        return _model(library.read_kind(name, folder), draw, library.read_materials(folder))
    except MisplacedError as error:
        path = folder / f"{kind_names(folder)[name]}.yaml"
        raise InputError(path, f"{name}.{error.key}".rstrip("."), str(error)) from error


def _model(kind: Kind, draw: Draw, materials: Materials) -> ObjectModel:
    drawn = {name: at_share(size, draw.shares[name]) for name, size in kind.sizes.items()}
    parts = build_parts(kind, drawn, lambda name, part: _look(name, part, kind, draw, materials))
    main = materials.materials[next(iter(kind.parts.values())).material]
    return ObjectModel(parts, main.density_kg_m3, kind.shell_thickness_m)


def build_parts(
    blueprint: Blueprint,
    drawn: Mapping[str, float],
    look: Callable[[str, KindPart], tuple[Material, float | None]],
) -> tuple[Part, ...]:
    """The parts of an object.

    Args:
        drawn: dimensions that the blueprint's expressions use.
        look: material and density of a part by name.

    Raises:
        MisplacedError: a mistake in the blueprint; names its key.
    """
    values = _all_dimensions(blueprint, drawn)
    made: dict[str, Manifold] = {}
    for name, described in blueprint.shapes.items():
        key = f"shapes.{name}"
        made[name] = shapes.union(_evaluated(described, values, key), made, key)
    parts = []
    for name, given in blueprint.parts.items():
        key = f"parts.{name}"
        part = _evaluated(given, values, key)
        solid = shapes.union(part.solids, made, f"{key}.solids")
        if part.cut:
            solid -= shapes.union(part.cut, made, f"{key}.cut")
        if solid.is_empty():
            raise MisplacedError(key, "is empty: check its dimensions and cut")
        role = PartRole.check({"role": given.role, "attributes": given.attributes})
        parts.append(Part(name, solid, *look(name, given), role))
    return tuple(parts)


def _look(
    name: str, part: KindPart, kind: Kind, draw: Draw, materials: Materials
) -> tuple[Material, float]:
    """A part's material and density."""
    if part.material not in materials.materials:
        raise MisplacedError(
            f"parts.{name}.material",
            f"'{part.material}' is not in {MATERIALS}: {', '.join(materials.materials)}",
        )
    surface = materials.materials[part.material]
    choices = part.colour or surface.colour
    key, owner = f"parts.{name}.colour", name
    if isinstance(choices, str) and choices in kind.colours:
        key, owner, choices = f"colours.{choices}", choices, kind.colours[choices]
    names = (choices,) if isinstance(choices, str) else choices
    for colour in names:
        if colour not in materials.colours:
            raise MisplacedError(key, f"'{colour}' is not a colour: {', '.join(materials.colours)}")
    chosen = names[min(int(draw.colours.get(owner, 0.0) * len(names)), len(names) - 1)]
    rgba = (*materials.colours[chosen], surface.opacity)
    return Material(rgba, surface.metallic, surface.roughness), surface.density_kg_m3  # type: ignore[arg-type]


def _evaluated(node: Any, values: Mapping[str, float], key: str) -> Any:
    """The same description with numbers instead of expressions.

    Raises:
        MisplacedError: names the key of an expression that has no value.
    """
    if isinstance(node, Expression):
        try:
            return node.value(values)
        except ValueError as error:
            raise MisplacedError(key, str(error)) from error
    if isinstance(node, tuple):
        return tuple(_evaluated(one, values, f"{key}.{at}") for at, one in enumerate(node))
    if isinstance(node, dict):
        return {name: _evaluated(one, values, f"{key}.{name}") for name, one in node.items()}
    if isinstance(node, BaseModel):
        fields = node.model_fields_set
        new = {name: _evaluated(getattr(node, name), values, f"{key}.{name}") for name in fields}
        return node.model_copy(update=new)
    return node
