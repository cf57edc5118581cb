"""Shared by all benchmarks: timing in turns with a reference, and the table of figures."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
from numpy.typing import NDArray

FIGURE_SCHEMA = pa.DataFrameSchema(
    {
        "name": pa.Column(str),
        "value": pa.Column(float, pa.Check.ge(0)),
        "unit": pa.Column(str),
        "reference": pa.Column(float, pa.Check.gt(0)),
        "ratio": pa.Column(float, pa.Check.ge(0)),
    },
    strict=True,
    unique=["name"],
)
_LINE = "{:44} {:>12} {:12} {:>12} {:>7}"


class NotReady(Exception):
    """A part cannot be measured here; the message says why."""


class Figure(NamedTuple):
    """A measured value and its reference, in the same unit."""

    name: str
    value: float
    unit: str
    reference: float
    ratio: float
    """Value over reference."""


def figure(name: str, value: float, unit: str, reference: float) -> Figure:
    """A value with a reference that is not measured in turns with it."""
    return Figure(name, float(value), unit, float(reference), float(value / reference))


def seconds(
    *works: Callable[[], object],
    rounds: int,
    warm_up: bool = True,
    clock: Callable[[], float] = time.perf_counter,
) -> NDArray[np.float64]:
    """Time (rounds, works), seconds, of works that take turns.

    A busy machine slows all works of a round alike, so their ratios are reliable.

    Args:
        warm_up: run an extra, uncounted round first, to compile and fill caches.
        clock: wall time; for works of one thread ``time.process_time`` leaves other processes out.
    """
    taken = np.empty((rounds + warm_up, len(works)))
    for turn in taken:
        for place, work in enumerate(works):
            begun = clock()
            work()
            turn[place] = clock() - begun
    return taken[warm_up:]


def rates(name: str, unit: str, taken_s: NDArray[np.float64], done: int) -> Figure:
    """Our rate and the reference's in things per second: medians, and the ratio over the rounds.

    Args:
        taken_s: (rounds, 2) of :func:`seconds`, ours first.
        done: number of things done per turn.
    """
    ours, reference = done / np.median(taken_s, axis=0)
    ratio = np.median(taken_s[:, 1] / taken_s[:, 0])
    return Figure(name, float(ours), unit, float(reference), float(ratio))


def header() -> str:
    """The first line of the printed table."""
    return _LINE.format("", "value", "", "reference", "ratio")


def line(found: Figure) -> str:
    """One line of the printed table."""
    value, reference = _digits(found.value), _digits(found.reference)
    return _LINE.format(found.name, value, found.unit, reference, f"{found.ratio:.2f}")


def table(figures: Iterable[Figure]) -> pd.DataFrame:
    """The figures as `reports/benchmarks.csv` holds them, with four significant digits."""
    columns = list(Figure._fields)
    found = pd.DataFrame([list(one) for one in figures], columns=columns)
    numbers = ["value", "reference", "ratio"]
    found[numbers] = found[numbers].astype(float).map(lambda value: float(f"{value:.4g}"))
    return found


def _digits(value: float) -> str:
    places = max(0, 2 - math.floor(math.log10(value))) if value > 0 else 0
    return f"{value:,.{min(places, 4)}f}"
