"""How well models name grasp types that have learnt from few images of each object.

The test images are those of Table I. Fewer images are shown more often, so that all models are
trained with the same number of steps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member, members_by_group
from grasptypes.predictors.scoring import METRIC_SCHEMA, SHORT, score
from grasptypes.predictors.training import fit, predict
from grasptypes.predictors.variants import VARIANTS
from grasptypes.settings.predictors import PredictorSettings

_VIEWS = pa.Column(int, pa.Check.ge(1), description="training images of each object")
TRIAL_SCHEMA = pa.DataFrameSchema(
    {**METRIC_SCHEMA.columns, "views": _VIEWS},
    strict=True,
    coerce=True,
    unique=["labels", "model", "views", "group", "seed"],
)
_SHARE = pa.Check.in_range(0, 1)
CURVE_SCHEMA = pa.DataFrameSchema(
    {
        "labels": pa.Column(str),
        "model": pa.Column(str, pa.Check.isin(list(VARIANTS))),
        "views": _VIEWS,
        **{f"{short}_mean": pa.Column(float, _SHARE) for short in SHORT.values()},
        **{f"{short}_se": pa.Column(float, pa.Check.ge(0)) for short in SHORT.values()},
        "n_runs": pa.Column(int, pa.Check.ge(2), description="folds and seeds"),
    },
    strict=True,
    unique=["labels", "model", "views"],
)


def first_views(index: pd.DataFrame, rows: np.ndarray, views: int) -> np.ndarray:
    """Those of some examples that show one of the first images of their object among them.

    Args:
        index: of :class:`Examples`.
        rows: (n,) rows of the examples.
        views: images of each object; objects with fewer keep all of them.
    """
    place = index.iloc[rows].groupby("object")["view"].rank(method="dense")
    kept: np.ndarray = rows[(place <= views).to_numpy()]
    return kept


def try_views(
    examples: Examples,
    views: Sequence[int],
    settings: PredictorSettings,
    key: tuple[str | int, ...],
) -> pd.DataFrame:
    """Train with fewer images and test: a row for each number of images, fold and seed.

    Args:
        views: numbers of training images of each object.
        settings: of training with all images.
        key: name of the computation, for its random numbers.
    """
    members = members_by_group(examples.index["fold"], settings.seeds)
    steps = _steps(members, settings) * settings.epochs
    tables = []
    for number in views:
        fewer = [
            replace(
                member,
                train=first_views(examples.index, member.train, number),
                test=np.arange(0),
            )
            for member in members
        ]
        epochs = max(1, round(steps / _steps(fewer, settings)))
        heads, _ = fit(examples, fewer, settings.changed(epochs=epochs), key)
        logits = [predict(heads, k, examples, member.test) for k, member in enumerate(members)]
        tested = [
            replace(member, train=own.train) for member, own in zip(members, fewer, strict=True)
        ]
        metrics, _ = score(examples, tested, logits)
        tables.append(metrics.assign(views=number))
    return pd.concat(tables, ignore_index=True)


def _steps(members: Sequence[Member], settings: PredictorSettings) -> int:
    """Steps of an epoch, see :func:`grasptypes.predictors.training.fit`."""
    smallest = min(len(member.train) for member in members)
    return smallest // min(settings.batch, smallest)


def summarize(trials: pd.DataFrame) -> pd.DataFrame:
    """A table of :data:`CURVE_SCHEMA` from trials of :data:`TRIAL_SCHEMA`."""
    keys = ["labels", "model", "views"]
    groups = trials.groupby(keys, sort=False)
    measures = groups[list(SHORT)]
    means = measures.mean().rename(columns={k: f"{v}_mean" for k, v in SHORT.items()})
    errors = measures.sem().rename(columns={k: f"{v}_se" for k, v in SHORT.items()})
    table = pd.concat([means, errors, groups.size().rename("n_runs")], axis=1).reset_index()
    return table[list(CURVE_SCHEMA.columns)].round(6)
