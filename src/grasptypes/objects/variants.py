"""Variants of catalogue objects by name: `mug_v01` is the first variant of `mug`."""

from __future__ import annotations

import re

from grasptypes.settings.objects import ObjectSettings

_NAME = re.compile(r"(.+)_v(\d\d)")


def variant_names(name: str, count: int) -> list[str]:
    """Names of the first `count` variants (at most 99) of an object."""
    return [f"{name}_v{number:02d}" for number in range(1, count + 1)]


def variant_of(name: str) -> tuple[str, int]:
    """The object that a name is a variant of, and the variant's number; 0 for the object itself."""
    found = _NAME.fullmatch(name)
    return (found[1], int(found[2])) if found else (name, 0)


def base_of(name: str) -> str:
    """The object that a name is a variant of; an object is its own."""
    return variant_of(name)[0]


def all_variants(objects: ObjectSettings) -> list[str]:
    """Names of the variants that the section `objects` of the parameters asks for."""
    return [variant for name in objects.names for variant in variant_names(name, objects.variants)]


def all_objects(objects: ObjectSettings) -> list[str]:
    """Every object of the parameters: those of the catalogue, their variants, the user's own."""
    return [*objects.names, *all_variants(objects), *objects.own]
