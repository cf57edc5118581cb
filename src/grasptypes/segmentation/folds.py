"""Which families of kinds are left out together when recognition is tested on unseen objects."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from grasptypes.errors import InputError
from grasptypes.seeds import rng

Relatives = Iterable[Sequence[str]]


def family_folds(
    families: NDArray[np.str_], count: int, key: Sequence[str | int], relatives: Relatives = ()
) -> NDArray[np.intp]:
    """Fold (n,) of each shape, 0 to count - 1; a family, and its relatives, are in the same one.

    Args:
        families: (n,) of the shapes.
        relatives: groups of families that an object is related to.
    """
    groups = family_groups(families, relatives)
    heads = np.array(sorted(set(groups.values())))
    fold = np.empty(len(heads), dtype=np.intp)
    fold[rng("family folds", *key).permutation(len(heads))] = np.arange(len(heads)) % count
    return fold[np.searchsorted(heads, [groups[name] for name in families])]


def family_groups(families: Iterable[str], relatives: Relatives) -> dict[str, str]:
    """The first family of the group of relatives that each family belongs to."""
    group = {name: name for name in map(str, families)}
    for some in relatives:
        joined = {group.setdefault(name, name) for name in some}
        group |= {name: min(joined) for name in group if group[name] in joined}
    return {name: group[name] for name in map(str, families)}


def learned_rows(
    families: NDArray[np.str_],
    fold: int | None,
    count: int,
    seed_number: int,
    relatives: Relatives = (),
) -> tuple[NDArray[np.intp], tuple[str | int, ...]]:
    """The shapes that the network of a fold learns from, and the name of its computation.

    Args:
        fold: the one that is left out; None for none.
    """
    if fold is None:
        return np.arange(len(families)), ("all", seed_number)
    folds = kind_folds(families, count, seed_number, relatives)
    return np.flatnonzero(folds != fold), ("fold", fold, seed_number)


def kind_folds(
    families: NDArray[np.str_], count: int, seed_number: int, relatives: Relatives
) -> NDArray[np.intp]:
    """Fold (n,) of each shape of a kind in all tests of recognition."""
    return family_folds(families, count, ("folds", seed_number), relatives)


def object_fold(name: str, own: Sequence[str], fold_of: dict[str, int]) -> int:
    """The fold in which all families of an object are.

    Args:
        own: its families.
        fold_of: fold of each family.

    Raises:
        InputError: its families are in several folds, so that no network knows none of them.
    """
    folds = {fold_of[family] for family in own if family in fold_of}
    if len(folds) > 1:
        raise InputError("params.yaml", f"general.protocol.families.{name}", "spans several folds")
    return folds.pop() if folds else 0
