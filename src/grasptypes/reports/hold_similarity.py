"""How well the table of holds predicts published labels of objects that it was not fitted on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
import pandera.pandas as pa
from numpy.typing import NDArray

from grasptypes.contact_maps.hold_fit import (
    Parameter,
    Problem,
    fit_parameters,
    leave_out_relatives,
    relatives_of,
)
from grasptypes.labels.samples import COUNTS
from grasptypes.predictors.metrics import angular_similarity
from grasptypes.settings.holds import HoldFitSettings

Array = NDArray[np.float64]
Key = tuple[str, str]

SIMILARITIES = ("held_out", "held_out_sets", "in_sample", "in_sample_sets")
MEANS = ("mean of fitted objects", "mean of other objects", "mean of all")
SIMILARITY_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        "fitted_on": pa.Column(str),
        **{name: pa.Column(float, pa.Check.ge(0)) for name in COUNTS},
        **{name: pa.Column(float, pa.Check.in_range(0, 1), nullable=True) for name in SIMILARITIES},
    },
    strict=True,
    ordered=True,
    unique=["object", "task"],
)
PARAMETER_SCHEMA = pa.DataFrameSchema(
    {
        "key": pa.Column(str, unique=True),
        "expected": pa.Column(float),
        "fitted": pa.Column(float),
        "in_table": pa.Column(float),
    },
    strict=True,
    ordered=True,
)


def compare_holds(
    parameters: Sequence[Parameter],
    problems: Mapping[Key, Problem],
    published: Mapping[Key, Array],
    fitted_on: Sequence[str],
    sessions: int,
    rarest: float,
    settings: HoldFitSettings,
) -> pd.DataFrame:
    """Angular similarity of predicted and published grasp types, as counts and as sets.

    Counts are what `sessions` people do by the table; `held_out` is with numbers fitted without the
    object and its relatives, `in_sample` with numbers fitted on all of `fitted_on`. An object that
    is not in `fitted_on` has no similarity in sample.

    Args:
        published: counts (6,) by object and task.

    Returns:
        A table of `SIMILARITY_SCHEMA`, with means in the last rows; its counts are held out.
    """
    used = [key for key in problems if key[0] in fitted_on]
    known = np.array([published[key] for key in used])
    whole = fit_parameters(parameters, [problems[key] for key in used], known, settings)
    without = leave_out_relatives(parameters, problems, published, fitted_on, settings)
    rows = []
    for key, problem in problems.items():
        held_out, in_sample = (
            session_counts(problem.type_shares(values, rarest), sessions)
            for values in (without[key[0]], whole)
        )
        others = len(set(fitted_on) - relatives_of(key[0], settings.relatives))
        scores = [*_similarities(held_out, published[key])]
        scores += _similarities(in_sample, published[key]) if key[0] in fitted_on else [np.nan] * 2
        rows.append([*key, f"{others} other objects", *held_out, *scores])
    table = pd.DataFrame(rows, columns=list(SIMILARITY_SCHEMA.columns))
    return pd.concat([table, _means(table, fitted_on)], ignore_index=True)


def compare_parameters(
    parameters: Sequence[Parameter],
    problems: Mapping[Key, Problem],
    published: Mapping[Key, Array],
    fitted_on: Sequence[str],
    settings: HoldFitSettings,
) -> pd.DataFrame:
    """The free numbers fitted on all of `fitted_on`, next to those in the table of holds.

    Returns:
        A table of `PARAMETER_SCHEMA`; priors are not logarithms here.
    """
    used = [key for key in problems if key[0] in fitted_on]
    known = np.array([published[key] for key in used])
    fitted = fit_parameters(parameters, [problems[key] for key in used], known, settings)
    rows = []
    for parameter, value in zip(parameters, fitted, strict=True):
        numbers = [parameter.expected, float(value)]
        if parameter.logarithmic:
            numbers = np.exp(numbers).tolist()
        rows.append([parameter.key, *np.round([*numbers, parameter.in_table], 2)])
    return pd.DataFrame(rows, columns=list(PARAMETER_SCHEMA.columns))


def session_counts(shares: Array, sessions: int) -> Array:
    """Whole counts (6,) of sessions in proportion to shares (6,), by largest remainders."""
    counts = np.floor(shares * sessions)
    left = round(sessions - counts.sum())
    counts[np.argsort(counts - shares * sessions, kind="stable")[:left]] += 1
    return np.asarray(counts)


def _similarities(predicted: Array, published: Array) -> tuple[float, float]:
    """Angular similarity of two vectors of counts (6,), and of the sets of types that occur."""
    sets = (predicted > 0).astype(float), (published > 0).astype(float)
    return (
        round(float(angular_similarity(predicted, published)), 4),
        round(float(angular_similarity(*sets)), 4),
    )


def _means(table: pd.DataFrame, fitted_on: Sequence[str]) -> pd.DataFrame:
    """One row for the fitted objects, one for the others and one for all, if there are any."""
    fitted = table.object.isin(fitted_on)
    numbers = [*COUNTS, *SIMILARITIES]
    rows = [
        {"object": name, "task": "mean", "fitted_on": "", **group[numbers].mean().round(4)}
        for name, group in zip(MEANS, (table[fitted], table[~fitted], table), strict=True)
        if len(group)
    ]
    return pd.DataFrame(rows)
