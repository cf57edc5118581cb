"""Agreement of the rule's labels with the human labels of the published grasps."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import minimize
from scipy.special import expit
from sklearn.metrics import cohen_kappa_score, confusion_matrix

from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand
from grasptypes.hands.states import HandStates
from grasptypes.labels.contacts import DistanceField
from grasptypes.labels.grasp_type import (
    INVALID,
    TYPES,
    Measures,
    classify,
    limits,
    measure,
    type_chances,
)
from grasptypes.settings.grasp_types import ContactSettings, Softness, Thresholds

Array = NDArray[np.float64]

ALL = "all"

AGREEMENT_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str, unique=True),
        "n": pa.Column(int, pa.Check.ge(1)),
        "accuracy": pa.Column(float, pa.Check.in_range(0, 1)),
        "kappa": pa.Column(float, pa.Check.in_range(-1, 1)),
        "fitted_on": pa.Column(str),
    },
    strict=True,
    ordered=True,
)
THRESHOLD_SCHEMA = AGREEMENT_SCHEMA.add_columns(
    {name: pa.Column(float, pa.Check.gt(0)) for name in Thresholds.model_fields}
)


class LabelledGrasps(NamedTuple):
    """Published grasps of n poses: human labels and measures."""

    objects: NDArray[np.str_]
    """(n,) names."""
    labels: NDArray[np.int64]
    """(n,) indices into `TYPES`."""
    measures: Measures
    """Fields (n,)."""

    def select(self, chosen: NDArray[np.bool_]) -> LabelledGrasps:
        """The grasps where `chosen` (n,) holds."""
        return LabelledGrasps(
            self.objects[chosen], self.labels[chosen], self.measures.select(chosen)
        )


def measure_published(
    published: pd.DataFrame,
    hand: Hand,
    fields: Mapping[str, DistanceField],
    settings: ContactSettings,
) -> LabelledGrasps:
    """Measure the published grasps with a human label and a configuration.

    Args:
        published: the table of `published.read_published`.
        hand: the hand of its poses.
        fields: distances to the objects, in the frame of the published poses; other objects are
            skipped.
    """
    known = published.hand_configuration.notna() & (published.grasp_type != INVALID)
    chosen = published[known & published.object.isin(list(fields))]
    parts = []
    for name, rows in chosen.groupby("object", sort=True):
        posed = configuration.unpack(np.stack(rows.hand_configuration.tolist()))
        states = HandStates(hand, posed.T_object_hand, hand.couple(posed.dofs))
        parts.append(np.stack(measure(fields[str(name)], states, settings)))
    ordered = chosen.sort_values("object", kind="stable")
    labels = np.array([TYPES.index(name) for name in ordered.grasp_type], dtype=np.int64)
    measures = Measures(*np.concatenate(parts, axis=1))
    return LabelledGrasps(ordered.object.to_numpy(dtype=str), labels, measures)


def agreement(
    grasps: LabelledGrasps, predicted: NDArray[np.int64], fitted_on: ArrayLike
) -> pd.DataFrame:
    """One row per object and one for all objects.

    Args:
        predicted: (n,) indices into `TYPES`.
        fitted_on: (n,) description of what the thresholds behind a prediction were fitted on; the
            same for all poses of an object.

    Returns:
        A table of `AGREEMENT_SCHEMA`. Kappa is 1 if only one type occurs in both labels.
    """
    fitted_on = np.asarray(fitted_on, dtype=str)
    rows = [
        _row(str(name), grasps.labels[own], predicted[own], fitted_on[own])
        for name in np.unique(grasps.objects)
        for own in [grasps.objects == name]
    ]
    rows.append(_row(ALL, grasps.labels, predicted, fitted_on))
    return pd.DataFrame(rows, columns=list(AGREEMENT_SCHEMA.columns))


def _row(
    name: str, labels: NDArray[np.int64], predicted: NDArray[np.int64], fitted_on: NDArray[np.str_]
) -> dict[str, str | int | float]:
    alone = len(np.unique(np.concatenate([labels, predicted]))) == 1
    kappa = 1.0 if alone else float(cohen_kappa_score(labels, predicted))
    kinds = np.unique(fitted_on)
    return {
        "object": name,
        "n": len(labels),
        "accuracy": round(float(np.mean(labels == predicted)), 4),
        "kappa": round(kappa, 4),
        "fitted_on": str(kinds[0]) if len(kinds) == 1 else "; ".join(kinds),
    }


def describe_fit(objects: Iterable[str], fitted_on: Iterable[str]) -> list[str]:
    """For each object, a description of whether thresholds fitted on `fitted_on` had seen it."""
    seen = set(fitted_on)
    own, others = f"{len(seen)} objects, this one too", f"{len(seen)} other objects"
    return [own if name in seen else others for name in objects]


def confusion(grasps: LabelledGrasps, predicted: NDArray[np.int64]) -> NDArray[np.int64]:
    """Counts (6, 6): rows are human labels, columns the rule's."""
    return np.asarray(confusion_matrix(grasps.labels, predicted, labels=np.arange(len(TYPES))))


def fit_thresholds(grasps: LabelledGrasps, softness: Softness) -> Array:
    """Thresholds (4,) with the highest expected accuracy if branches are taken with probability.

    It is logistic in the logarithm of measure over threshold, divided by `softness`: a smooth
    objective has one broad maximum, while plain accuracy has many narrow ones. The search starts at
    the medians of the measures, so that the result depends only on these grasps.
    """
    measured = np.log(np.maximum(np.stack(grasps.measures), 1e-6))
    widths = limits(softness)[:, None]

    def loss(log_thresholds: Array) -> float:
        """Negative mean probability of the human labels with soft thresholds (4,)."""
        chance = type_chances(expit((measured - log_thresholds[:, None]) / widths))
        return -float(chance[grasps.labels, np.arange(len(grasps.labels))].mean())

    options = {"maxiter": 600, "xatol": 1e-4, "fatol": 1e-7}
    start = np.median(measured, axis=1)
    return np.asarray(np.exp(minimize(loss, start, method="Nelder-Mead", options=options).x))


def groups_of(
    objects: Iterable[str], relatives: Iterable[Collection[str]]
) -> dict[str, frozenset[str]]:
    """Each object with its relatives, of which it may have none."""
    related = {name: frozenset(group) for group in relatives for name in group}
    return {name: related.get(name, frozenset([name])) for name in objects}


def cross_validate(
    grasps: LabelledGrasps, softness: Softness, relatives: Iterable[Collection[str]] = ()
) -> pd.DataFrame:
    """Label each object with thresholds fitted on all that are no relatives of it.

    Args:
        relatives: groups of objects that are held alike; others have none.

    Returns:
        A table of `THRESHOLD_SCHEMA`: an object's row has the thresholds it was labelled with,
        the last row those fitted on all objects (its accuracy is that of all rows above together).
    """
    predicted = np.empty(len(grasps.labels), dtype=np.int64)
    names = [str(name) for name in np.unique(grasps.objects)]
    groups = groups_of(names, relatives)
    fits = {
        group: fit_thresholds(grasps.select(~np.isin(grasps.objects, [*group])), softness)
        for group in dict.fromkeys(groups[name] for name in names)
    }
    for group, thresholds in fits.items():
        own = np.isin(grasps.objects, [*group])
        predicted[own] = classify(grasps.measures.select(own), thresholds)
    fitted = [*(fits[groups[name]] for name in names), fit_thresholds(grasps, softness)]
    words = [
        f"{len(names) - len(groups[str(name)] & {*names})} other objects" for name in grasps.objects
    ]
    table = agreement(grasps, predicted, words)
    thresholds = pd.DataFrame(fitted, columns=list(Thresholds.model_fields)).round(5)
    return pd.concat([table, thresholds], axis=1)
