"""Tables of test results of trained predictors, one row per member."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.labels.samples import TYPES
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member
from grasptypes.predictors.metrics import METRICS, evaluate
from grasptypes.predictors.variants import VARIANTS
from grasptypes.predictors.weights import BackboneRecord

# Prefixes of the columns of a table, by measure.
SHORT = {
    "angular_similarity": "sim",
    "multilabel_accuracy": "acc",
    "multilabel_precision": "prec",
    "frequency_similarity": "freq",
}

_SHARE = pa.Check.in_range(0, 1)
METRIC_SCHEMA = pa.DataFrameSchema(
    {
        "labels": pa.Column(str),
        "model": pa.Column(str, pa.Check.isin(list(VARIANTS))),
        "group": pa.Column(str),
        "seed": pa.Column(int, pa.Check.ge(0)),
        "n_train": pa.Column(int, pa.Check.gt(0)),
        "n_test": pa.Column(int, pa.Check.gt(0)),
        **{name: pa.Column(float, _SHARE) for name in METRICS},
        "backbone": pa.Column(str),
        "weights": pa.Column(str),
        "finetune": pa.Column(str),
    },
    strict=True,
    coerce=True,
    unique=["labels", "model", "group", "seed"],
)
CURVE_SCHEMA = pa.DataFrameSchema(
    {
        "group": pa.Column(str),
        "seed": pa.Column(int),
        "epoch": pa.Column(int, pa.Check.gt(0)),
        "train_loss": pa.Column(float),
        "test_loss": pa.Column(float, nullable=True),
    },
    strict=True,
    coerce=True,
)
PREDICTION_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "view": pa.Column(int),
        "task": pa.Column(str),
        "group": pa.Column(str),
        "seed": pa.Column(int),
        **{f"logit_{name}": pa.Column("float32") for name in TYPES},
    },
    strict=True,
)


def score(
    examples: Examples, members: Sequence[Member], logits: Sequence[np.ndarray]
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Metrics, one row per member; and predictions, one row per member and test example.

    Args:
        logits: for each member, (m, types) of its test examples.
    """
    metrics, predictions = [], []
    for member, outputs in zip(members, logits, strict=True):
        name = {"group": member.group, "seed": member.seed}
        sizes = {"n_train": len(member.train), "n_test": len(member.test)}
        rows = member.test
        values = evaluate(outputs, examples.labels[rows], examples.frequencies[rows])
        metrics.append(name | sizes | values)
        numbers = pd.DataFrame(outputs, columns=[f"logit_{t}" for t in TYPES], dtype=np.float32)
        where = examples.index.iloc[rows][["object", "view", "task"]].reset_index(drop=True)
        predictions.append(pd.concat([where.assign(**name), numbers], axis=1))
    return pd.DataFrame(metrics), pd.concat(predictions, ignore_index=True)


def with_source(
    metrics: pd.DataFrame, name: tuple[str, str], backbone: BackboneRecord, finetune: str
) -> pd.DataFrame:
    """Metrics of :func:`score` as a table of :data:`METRIC_SCHEMA`, with their source.

    Args:
        name: label source and model.
    """
    source = {"labels": name[0], "model": name[1]}
    used = {"backbone": backbone.backbone, "weights": backbone.weights, "finetune": finetune}
    return metrics.assign(**source, **used)[list(METRIC_SCHEMA.columns)]


def curve_table(members: Sequence[Member], curves: np.ndarray) -> pd.DataFrame:
    """Loss curves (epochs, members, 2) as a table of :data:`CURVE_SCHEMA`."""
    epochs = np.arange(1, len(curves) + 1)
    tables = [
        pd.DataFrame({"group": member.group, "seed": member.seed, "epoch": epochs})
        .assign(train_loss=curves[:, number, 0], test_loss=curves[:, number, 1])
        for number, member in enumerate(members)
    ]  # fmt: skip
    return pd.concat(tables, ignore_index=True)
