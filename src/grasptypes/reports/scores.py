"""Summaries of the results: a small file per model and label source, and one for the grasps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from grasptypes.predictors.scoring import SHORT

MEASURES = dict(
    zip(SHORT.values(), ("similarity", "accuracy", "precision", "frequencies"), strict=True)
)
DIGITS = 4  # two more than in the paper's tables


def model_scores(
    known: pd.DataFrame, unseen: pd.DataFrame, models: list[str]
) -> dict[tuple[str, str], dict[str, Any]]:
    """Each model's measures by label source and model.

    Args:
        known, unseen: tables of `results.RESULT_SCHEMA` for known and left-out objects.

    Returns:
        similarity, accuracy, precision and similarity to the frequencies (``frequencies``), and
        the same under ``unseen`` if measured.
    """
    scores = {name: row for name, row in _measures(known).items() if name[1] in models}
    for name, row in _measures(unseen).items():
        if name in scores:
            scores[name]["unseen"] = row
    return scores


def grasp_scores(dataset: pd.DataFrame, distribution: pd.DataFrame | None) -> Mapping[str, Any]:
    """Number of valid grasps, and similarity of their type counts to the published ones.

    Args:
        dataset: of `dataset.dataset_schema`.
        distribution: of `distribution.DISTRIBUTION_SCHEMA`, with the mean in the last row; None if
            no object has published counts, in which case there is no similarity.
    """
    scores: dict[str, Any] = {
        "tried": len(dataset),
        "valid": int((dataset.GraspType != "Invalid").sum()),
    }
    if distribution is not None:
        scores["similarity"] = round(float(distribution.similarity.iloc[-1]), DIGITS)
    return scores


def _measures(table: pd.DataFrame) -> dict[tuple[str, str], dict[str, Any]]:
    """The means of a table's rows by label source and model."""
    return {
        (str(row["labels"]), str(row["model"])): {
            measure: round(float(row[f"{short}_mean"]), DIGITS)
            for short, measure in MEASURES.items()
        }
        for row in table.dropna(subset=["labels"]).to_dict("records")
    }
