"""Splits that test a predictor on objects it has not seen in any shape."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from grasptypes.objects.variants import base_of
from grasptypes.predictors.training import Member


def members_by_object(
    objects: Sequence[str], seeds: int, learnt: np.ndarray | None = None
) -> list[Member]:
    """One member per object and seed, tested on it and trained on the others with their variants.

    Args:
        objects: (N,) object of every example, including variants.
        seeds: number of repetitions.
        learnt: (N,) which examples may be trained on; default: all.
    """
    column = np.asarray(objects)
    bases = np.array([base_of(name) for name in column])
    allowed = np.ones(len(column), dtype=bool) if learnt is None else np.asarray(learnt)
    return [
        Member(
            str(name), k, np.flatnonzero((bases != name) & allowed), np.flatnonzero(column == name)
        )
        for k in range(seeds)
        for name in np.unique(bases)
    ]
