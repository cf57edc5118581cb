"""Agreement of the rule's labels with the human labels of the published grasps."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np
import pandas as pd
import pandera.pandas as pa
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import minimize
from scipy.special import expit
from sklearn.metrics import cohen_kappa_score

from grasptypes.hand import configuration, kinematics
from grasptypes.labels.contacts import DistanceField, find_contacts
from grasptypes.labels.grasp_type import (
    GRASP_TYPES,
    INVALID,
    Measures,
    classify,
    measure,
    type_chances,
)
from grasptypes.settings.grasp_types import ContactSettings, Softness, Thresholds

Array = NDArray[np.float64]

ALL = "all"
TYPES = GRASP_TYPES[: GRASP_TYPES.index(INVALID)]
# In the order of `Measures`.
THRESHOLDS = tuple(Thresholds.model_fields)

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
THRESHOLD_SCHEMA = pa.DataFrameSchema(
    {
        **AGREEMENT_SCHEMA.columns,
        **{name: pa.Column(float, pa.Check.gt(0)) for name in THRESHOLDS},
    },
    strict=True,
    ordered=True,
)


class PublishedMeasures(NamedTuple):
    """Published grasps of n poses: human labels and measures."""

    objects: NDArray[np.str_]
    """(n,) names."""
    labels: NDArray[np.int64]
    """(n,) indices into `TYPES`."""
    measures: Measures
    """Fields (n,)."""

    def select(self, chosen: NDArray[np.bool_]) -> PublishedMeasures:
        """The grasps where `chosen` (n,) holds."""
        measures = Measures(*(values[chosen] for values in self.measures))
        return PublishedMeasures(self.objects[chosen], self.labels[chosen], measures)


def measure_published(
    published: pd.DataFrame, fields: Mapping[str, DistanceField], settings: ContactSettings
) -> PublishedMeasures:
    """Measure the published grasps with a human label and a configuration.

    Args:
        published: the table of `published.read_published`.
        fields: distances to the objects, in the frame of the published poses; other objects are
            skipped.
    """
    known = published.hand_configuration.notna() & (published.grasp_type != INVALID)
    chosen = published[known & published.object.isin(list(fields))]
    parts = [
        _measure(np.stack(rows.hand_configuration.tolist()), fields[str(name)], settings)
        for name, rows in chosen.groupby("object", sort=True)
    ]
    ordered = chosen.sort_values("object", kind="stable")
    labels = np.array([TYPES.index(name) for name in ordered.grasp_type], dtype=np.int64)
    columns = np.concatenate([np.stack(part) for part in parts], axis=1)
    return PublishedMeasures(ordered.object.to_numpy(dtype=str), labels, Measures(*columns))


def _measure(numbers: Array, field: DistanceField, settings: ContactSettings) -> Measures:
    hand = configuration.unpack(numbers)
    joint_angles = kinematics.couple(hand.dofs_rad)
    return measure(find_contacts(field, hand.T_object_hand, joint_angles, settings), joint_angles)


def agreement(
    published: PublishedMeasures, predicted: NDArray[np.int64], fitted_on: ArrayLike
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
        _row(str(name), published.labels[own], predicted[own], fitted_on[own])
        for name in np.unique(published.objects)
        for own in [published.objects == name]
    ]
    rows.append(_row(ALL, published.labels, predicted, fitted_on))
    return pd.DataFrame(rows, columns=list(AGREEMENT_SCHEMA.columns))


def _row(
    name: str,
    labels: NDArray[np.int64],
    predicted: NDArray[np.int64],
    fitted_on: NDArray[np.str_],
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


def confusion(published: PublishedMeasures, predicted: NDArray[np.int64]) -> NDArray[np.int64]:
    """Counts (6, 6): rows are human labels, columns the rule's."""
    counts = np.zeros((len(TYPES), len(TYPES)), dtype=np.int64)
    np.add.at(counts, (published.labels, predicted), 1)
    return counts


def fit_thresholds(published: PublishedMeasures, softness: Softness) -> Thresholds:
    """Thresholds with the highest expected accuracy if branches are taken with logistic
    probability.

    The probability depends on the logarithm of measure over threshold, divided by `softness`: a
    smooth objective has one broad maximum, while plain accuracy has many narrow ones. The search
    starts at the medians of the measures, so that the result depends only on these grasps.
    """
    measured = np.log(np.maximum(np.stack(published.measures), 1e-6))
    widths = np.array([getattr(softness, name) for name in THRESHOLDS])[:, None]
    rows = np.arange(len(published.labels))

    def loss(log_thresholds: Array) -> float:
        """Negative mean probability of the human labels with soft thresholds (4,)."""
        above = expit((measured - log_thresholds[:, None]) / widths)
        chance = type_chances(dict(zip(Measures._fields, above, strict=True)))
        return -float(chance[published.labels, rows].mean())

    options = {"maxiter": 600, "xatol": 1e-4, "fatol": 1e-7}
    start = np.median(measured, axis=1)
    best = minimize(loss, start, method="Nelder-Mead", options=options)
    return Thresholds(**dict(zip(THRESHOLDS, np.exp(best.x).tolist(), strict=True)))


def cross_validate(published: PublishedMeasures, softness: Softness) -> pd.DataFrame:
    """Label each object with thresholds fitted on all others.

    Returns:
        A table of `THRESHOLD_SCHEMA`: an object's row has the thresholds it was labelled with,
        the last row those fitted on all objects (its accuracy is that of all rows above together).
    """
    predicted = np.empty(len(published.labels), dtype=np.int64)
    names = np.unique(published.objects)
    fitted = []
    for name in names:
        own = published.objects == name
        fitted.append(fit_thresholds(published.select(~own), softness))
        predicted[own] = classify(published.select(own).measures, fitted[-1])
    fitted.append(fit_thresholds(published, softness))
    words = [f"{len(names) - 1} other objects"] * len(predicted)
    table = agreement(published, predicted, words)
    return pd.concat(
        [table, pd.DataFrame([found.model_dump() for found in fitted]).round(5)], axis=1
    )
