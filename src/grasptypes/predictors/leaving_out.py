"""Which examples test a predictor on an object it has never seen, in none of its shapes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from grasptypes.objects.variants import base_of
from grasptypes.predictors.training import Member


def members_by_object(
    objects: Sequence[str], seeds: int, learnt: np.ndarray | None = None
) -> list[Member]:
    """One member an object and seed, tested on it and trained on the others and their variants.

    Args:
        objects: (N,) of every example, variants among them.
        seeds: repetitions.
        learnt: (N,) truth values: which examples may be trained on; all if left out.
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
