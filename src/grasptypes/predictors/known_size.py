"""What a user says of an object's size and mass, as inputs of a predictor."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from grasptypes.errors import InputError
from grasptypes.objects.units import UNITS_M
from grasptypes.predictors.general_inputs import SIZE
from grasptypes.settings.commands import PredictSettings

_NUMBER = r"(?:\d+\.?\d*|\.\d+)"
_SIZE = re.compile(rf"(?P<lengths>{_NUMBER}(?:x{_NUMBER})*)\s*(?P<unit>[a-z]*)")


def read_size(text: str) -> tuple[float, ...]:
    """The lengths in metres, longest first, of a size in words: 12cm, or 12x5x3cm.

    Raises:
        InputError: the text is no size, has no unit, or two lengths.
    """
    found = _SIZE.fullmatch(text.strip().lower())
    if found is None:
        raise InputError("--size", text, "must be a length or all three: 12cm, or 12x5x3cm")
    unit = found["unit"]
    if unit not in UNITS_M:
        named = f"'{unit}' is no unit" if unit else "has no unit"
        raise InputError("--size", text, f"{named}; allowed: {', '.join(UNITS_M)}")
    lengths = found["lengths"].split("x")
    return tuple(sorted((float(length) * UNITS_M[unit] for length in lengths), reverse=True))


def facts_of_size(
    size_m: float | Sequence[float], mass_kg: float | None, settings: PredictSettings
) -> list[float]:
    """The numbers of `general_inputs.FACTS`, NaN where nothing is said.

    Args:
        size_m: the longest extent, or all three; nothing if unknown.
        settings: how large and heavy objects are.

    Raises:
        InputError: a number is out of range, or there are two extents.
    """
    lengths = size_m if isinstance(size_m, Sequence) else (size_m,)
    if len(lengths) not in (0, 1, len(SIZE)):
        raise InputError("--size", str(len(lengths)), "give the longest extent, or all three")
    for value in lengths:
        _check("--size", value, settings.size_m, "m")
    if mass_kg is not None:
        _check("--mass-kg", mass_kg, settings.mass_kg, "kg")
    sorted_m = sorted(lengths, reverse=True)
    known = [float(np.log(value)) for value in sorted_m]
    missing = [np.nan] * (len(SIZE) - len(known))
    return [*known, *missing, np.nan if mass_kg is None else float(np.log(mass_kg))]


def _check(option: str, value: float, limits: tuple[float, float], unit: str) -> None:
    low, high = limits
    if not low <= value <= high:
        raise InputError(option, f"{value:g} {unit}", f"must be {low:g} to {high:g} {unit}")
