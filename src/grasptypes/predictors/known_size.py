"""What a user says of an object's size and mass, as inputs of a predictor."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from grasptypes.errors import InputError
from grasptypes.predictors.general_inputs import SIZE
from grasptypes.settings.commands import PredictSettings


def facts_of_size(
    size_m: Sequence[float], mass_kg: float | None, settings: PredictSettings
) -> list[float]:
    """The numbers of `general_inputs.FACTS`, NaN where nothing is said.

    Args:
        size_m: the longest extent, or all three; nothing if unknown.
        settings: how large and heavy objects are.

    Raises:
        InputError: a number is out of range, or there are two extents.
    """
    if len(size_m) not in (0, 1, len(SIZE)):
        raise InputError("--size-m", str(len(size_m)), "give the longest extent, or all three")
    for value in size_m:
        _check("--size-m", value, settings.size_m)
    if mass_kg is not None:
        _check("--mass-kg", mass_kg, settings.mass_kg)
    sorted_m = sorted(size_m, reverse=True)
    known = [float(np.log(value)) for value in sorted_m]
    missing = [np.nan] * (len(SIZE) - len(known))
    return [*known, *missing, np.nan if mass_kg is None else float(np.log(mass_kg))]


def _check(option: str, value: float, limits: tuple[float, float]) -> None:
    low, high = limits
    if not low <= value <= high:
        raise InputError(option, f"{value:g}", f"must be {low:g} to {high:g}")
