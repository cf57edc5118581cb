"""Families of objects, which are alike and held out together."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

import numpy as np

from grasptypes.seeds import rng

Families = Mapping[str, frozenset[str]]


def family_folds(families: Families, count: int, seed: int) -> list[frozenset[str]]:
    """Families in `count` groups of about as many objects, each to be held out in turn.

    Args:
        families: of each object; the first in the alphabet decides where an object with several is.
        seed: of the workflow.
    """
    names = Counter(min(own) for own in families.values())
    shuffled = sorted(names, key=lambda name: rng("family", name, seed).random())
    folds: list[set[str]] = [set() for _ in range(min(count, len(names)))]
    sizes = np.zeros(len(folds), dtype=int)
    for name in sorted(shuffled, key=lambda name: -names[name]):
        smallest = int(np.argmin(sizes))
        folds[smallest].add(name)
        sizes[smallest] += names[name]
    return [frozenset(fold) for fold in folds]
