"""Variants of catalogue objects by name: `mug_v01` is the first variant of `mug`."""

from __future__ import annotations

import re

from grasptypes.settings.objects import ObjectSettings

_NAME = re.compile(r"(.+)_v(\d\d)")


def variant_names(name: str, count: int) -> list[str]:
    """Names of the first `count` variants (at most 99) of an object."""
    return [f"{name}_v{number:02d}" for number in range(1, count + 1)]


def variant_of(name: str) -> tuple[str, int]:
    """Base object and variant number of a name; 0 for the object itself."""
    found = _NAME.fullmatch(name)
    return (found[1], int(found[2])) if found else (name, 0)


def base_of(name: str) -> str:
    """Base object of a name; that of an object is itself."""
    return variant_of(name)[0]


def all_variants(objects: ObjectSettings) -> list[str]:
    """Names of all variants in the section `objects` of the parameters."""
    return [variant for name in objects.names for variant in variant_names(name, objects.variants)]


def all_objects(objects: ObjectSettings) -> list[str]:
    """All objects of the parameters: from the catalogue, their variants, and the user's own."""
    return [*objects.names, *all_variants(objects), *objects.own]
