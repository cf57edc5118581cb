"""Splits of the examples: what a head is trained on, and what it is tested on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from grasptypes.objects.variants import base_of


@dataclass(frozen=True)
class Member:
    """One head to train: its training and test examples, and its key.

    Attributes:
        group: name of the split, for example the fold; members of a group share their examples.
        seed: number of the repetition.
        train: (n,) rows of the examples.
        test: (m,) rows of the examples; may be empty.
    """

    group: str
    seed: int
    train: np.ndarray
    test: np.ndarray


def members_by_group(groups: Sequence[object], seeds: int) -> list[Member]:
    """One member per group and seed, tested on the group and trained on all others.

    Args:
        groups: (N,) group of every example, such as its fold.
    """
    column = np.asarray(groups)
    return _members(column, column, np.ones(len(column), dtype=bool), seeds)


def members_by_object(
    objects: Sequence[str], seeds: int, learnt: np.ndarray | None = None
) -> list[Member]:
    """One member per object and seed, tested on it and trained on the others with their variants.

    Args:
        objects: (N,) object of every example, including variants.
        seeds: number of repetitions.
        learnt: (N,) which examples may be trained on; default: all.
    """
    bases = np.array([base_of(name) for name in objects])
    allowed = np.ones(len(bases), dtype=bool) if learnt is None else np.asarray(learnt)
    return _members(np.asarray(objects), bases, allowed, seeds)


def _members(
    groups: np.ndarray, families: np.ndarray, learnt: np.ndarray, seeds: int
) -> list[Member]:
    """Members tested on a group that heads its family, which is left out of training."""
    rows = {
        str(name): (np.flatnonzero((families != name) & learnt), np.flatnonzero(groups == name))
        for name in np.unique(families)
    }
    return [Member(name, k, *split) for k in range(seeds) for name, split in rows.items()]
