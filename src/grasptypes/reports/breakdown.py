"""The models' results by grasp type and by object."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.labels.samples import COUNTS, TYPES
from grasptypes.predictors.metrics import METRICS, chosen, measures
from grasptypes.predictors.variants import VARIANTS

KNOWN, UNSEEN = "known", "unseen"
LOGITS = tuple(f"logit_{name}" for name in TYPES)

_SHARE = pa.Check.in_range(0, 1)
_SOURCE = {"labels": pa.Column(str), "model": pa.Column(str, pa.Check.isin(list(VARIANTS)))}
TYPE_SCHEMA = pa.DataFrameSchema(
    {
        **_SOURCE,
        "grasp_type": pa.Column(str, pa.Check.isin(TYPES)),
        "n_labelled": pa.Column(int, pa.Check.ge(0), description="answers that should name it"),
        "n_chosen": pa.Column(int, pa.Check.ge(0), description="answers that name it"),
        "n_right": pa.Column(int, pa.Check.ge(0), description="both"),
        "precision": pa.Column(float, _SHARE, nullable=True, description="right of the chosen"),
        "recall": pa.Column(float, _SHARE, nullable=True, description="right of the labelled"),
        "accuracy": pa.Column(float, _SHARE, description="answers right about this type"),
    },
    strict=True,
    ordered=True,
    unique=["labels", "model", "grasp_type"],
)
OBJECT_SCHEMA = pa.DataFrameSchema(
    {
        **_SOURCE,
        "objects": pa.Column(str, pa.Check.isin([KNOWN, UNSEEN])),
        "object": pa.Column(str),
        **{name: pa.Column(float, _SHARE) for name in METRICS},
    },
    strict=True,
    ordered=True,
    unique=["labels", "model", "objects", "object"],
)


def by_type(predictions: pd.DataFrame, samples: pd.DataFrame) -> pd.DataFrame:
    """Recall, precision and accuracy of each grasp type over all folds and seeds.

    Args:
        predictions: of `results.PREDICTION_SCHEMA`.
        samples: of `samples.SAMPLE_SCHEMA`.

    Returns:
        a table of `TYPE_SCHEMA` without the column of the label source, six rows.
    """
    truth = labels_for(predictions, samples)
    named = chosen(predictions[list(LOGITS)].to_numpy())
    right = (truth & named).sum(axis=0)
    return pd.DataFrame(
        {
            "grasp_type": TYPES,
            "n_labelled": truth.sum(axis=0),
            "n_chosen": named.sum(axis=0),
            "n_right": right,
            "precision": _share(right, named.sum(axis=0)),
            "recall": _share(right, truth.sum(axis=0)),
            "accuracy": (truth == named).mean(axis=0).round(6),
        }
    )


def by_object(predictions: pd.DataFrame, samples: pd.DataFrame) -> pd.DataFrame:
    """The mean of the measures for each object, over all folds and seeds.

    Args:
        predictions: of `results.PREDICTION_SCHEMA`.
        samples: of `samples.SAMPLE_SCHEMA`.

    Returns:
        columns object and `METRICS`.
    """
    counts = counts_for(predictions, samples)
    values = measures(predictions[list(LOGITS)].to_numpy(dtype=np.float64), counts > 0, counts)
    table = pd.DataFrame({"object": predictions["object"].to_numpy(), **values})
    return table.groupby("object", as_index=False)[list(METRICS)].mean().round(6)


def by_left_out_object(metrics: pd.DataFrame) -> pd.DataFrame:
    """The same for objects left out of training; their names are the groups in the metrics.

    Args:
        metrics: of `results.METRIC_SCHEMA`.
    """
    means = metrics.groupby("group", as_index=False)[list(METRICS)].mean().round(6)
    return means.rename(columns={"group": "object"})


def labels_for(predictions: pd.DataFrame, samples: pd.DataFrame) -> np.ndarray:
    """(N, types) labels for each prediction; without a task, those of all tasks together."""
    return counts_for(predictions, samples) > 0


def counts_for(predictions: pd.DataFrame, samples: pd.DataFrame) -> np.ndarray:
    """(N, types) numbers of grasps behind the labels of :func:`labels_for`."""
    alone = samples.set_index(["object", "task"])[list(COUNTS)]
    joint = alone.groupby("object").sum()
    joint.index = pd.MultiIndex.from_arrays(
        [joint.index, [""] * len(joint)], names=alone.index.names
    )
    keys = pd.MultiIndex.from_frame(predictions[["object", "task"]])
    counts: np.ndarray = pd.concat([alone, joint]).loc[keys].to_numpy()
    return counts


def _share(part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """`part` / `whole`, rounded; NaN where `whole` is 0."""
    share: np.ndarray = np.divide(part, whole, out=np.full(len(part), np.nan), where=whole > 0)
    return share.round(6)
