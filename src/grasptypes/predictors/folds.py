"""Assignment of images to folds."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.errors import InputError
from grasptypes.seeds import rng

FOLD_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "view": pa.Column(int, pa.Check.ge(0)),
        "fold": pa.Column(int, pa.Check.ge(0)),
    },
    strict=True,
    unique=["object", "view"],
)


def split(views: Mapping[str, int], folds: int, seed: int) -> pd.DataFrame:
    """Stratified folds over images (paper, section IV-A): each has its share of every object.

    Folds are assigned to images, regardless of tasks, so that all tasks of an image are in one
    fold.

    Args:
        views: object to its number of images.
        folds: number of folds.
        seed: seed of the workflow.

    Returns:
        one row per image: object, view, fold; see :data:`FOLD_SCHEMA`.

    Raises:
        InputError: an object has fewer images than there are folds.
    """
    rows: list[pd.DataFrame] = []
    before = 0
    for name, count in sorted(views.items()):
        if count < folds:
            raise InputError(
                "params.yaml",
                "folds.count",
                f"{folds} folds need at least as many views; {name} has {count}",
            )
        # Continue counting from object to object, so that leftover images do not pile up in fold 0.
        fold = (before + np.arange(count)) % folds
        before += count
        order = rng("folds", name, seed).permutation(count)
        rows.append(pd.DataFrame({"object": name, "view": order, "fold": fold}))
    return pd.concat(rows).sort_values(["object", "view"], ignore_index=True)
