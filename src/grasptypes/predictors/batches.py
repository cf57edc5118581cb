"""Images of any sizes in batches of one size each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np


def in_batches(
    pictures: Sequence[np.ndarray], count: int, see: Callable[[np.ndarray], Iterable[np.ndarray]]
) -> list[np.ndarray]:
    """What `see` returns for batches (B, S, S, 3) of images, as arrays over all images, in order.

    Args:
        pictures: (S, S, 3) uint8 each.
        count: images at once.
        see: takes a batch and returns arrays of B rows.
    """
    sizes = np.array([len(picture) for picture in pictures])
    places, told = [], []
    for size in np.unique(sizes):
        same = np.flatnonzero(sizes == size)
        for start in range(0, len(same), count):
            chosen = same[start : start + count]
            places.append(chosen)
            told.append(tuple(see(np.stack([pictures[k] for k in chosen]))))
    order = np.argsort(np.concatenate(places))
    return [np.concatenate(rows)[order] for rows in zip(*told, strict=True)]
