"""What limits the predictor for unseen objects: noise of labels, types and roles mistaken, and the
objects it knows least about.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.labels.dataset import sample_table
from grasptypes.labels.samples import COUNTS, LABELS, TYPES
from grasptypes.predictors.general_protocol import OCCURS
from grasptypes.predictors.metrics import SIGMOID_THRESHOLD, angular_similarity
from grasptypes.settings.tasks import Task

_SHARE = pa.Check.in_range(0, 1)
HALVES, SIMULATED_LABELS = "other half of the sessions", "simulated labels"
LIMIT_SCHEMA = pa.DataFrameSchema(
    {
        "shown": pa.Column(str),
        "labels": pa.Column(str, description="compared with"),
        "answer": pa.Column(str, pa.Check.isin([HALVES, SIMULATED_LABELS])),
        "n_objects": pa.Column(int, pa.Check.ge(1)),
        "similarity": pa.Column(float, _SHARE),
        "similarity_se": pa.Column(float, pa.Check.ge(0)),
        "similarity_shares": pa.Column(float, _SHARE),
    },
    strict=True,
    ordered=True,
    unique=["shown", "labels", "answer"],
)
CONFUSION_SCHEMA = pa.DataFrameSchema(
    {
        "by": pa.Column(str, pa.Check.isin(["type", "role"])),
        "name": pa.Column(str, description="grasp type, or role that people touch most"),
        "samples": pa.Column(int, pa.Check.ge(1), description="objects and tasks"),
        "occurs": pa.Column(float, _SHARE, description="share of the samples; of a role, per type"),
        "predicted": pa.Column(float, _SHARE, description="mean probability"),
        "found": pa.Column(float, _SHARE, nullable=True, description="share of what occurs"),
        "right": pa.Column(float, _SHARE, nullable=True, description="share of what is chosen"),
        "similarity": pa.Column(float, _SHARE, nullable=True, description="where it occurs"),
    },
    strict=True,
    ordered=True,
    unique=["by", "name"],
)


def halves(dataset: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Samples of the odd and of the even sessions, of pairs with valid grasps in both.

    Args:
        dataset: of `dataset.dataset_schema`.
    """
    parts = [sample_table(dataset[dataset.Session % 2 == odd], least=1) for odd in (1, 0)]
    keys = ["object", "task"]
    both = parts[0][keys].merge(parts[1][keys])
    odd, even = (both.merge(part) for part in parts)
    return odd, even


def limit_row(
    told: pd.DataFrame, true: pd.DataFrame, where: Mapping[str, str], sets: bool
) -> dict[str, object]:
    """A row of `LIMIT_SCHEMA`: how similar samples are to others of the same pairs, row by row.

    Args:
        where: the first columns.
        sets: whether the answer is the set of types, else their frequencies.
    """
    direction = told[list(LABELS if sets else COUNTS)]
    scores = pd.DataFrame(
        {
            "object": true["object"],
            "similarity": angular_similarity(direction, true[list(LABELS)]),
            "similarity_shares": angular_similarity(told[list(COUNTS)], true[list(COUNTS)]),
        }
    )
    means = scores.groupby("object").mean()
    return {
        **where,
        "n_objects": len(means),
        "similarity": round(means["similarity"].mean(), 4),
        "similarity_se": round(means["similarity"].sem(), 4),
        "similarity_shares": round(means["similarity_shares"].mean(), 4),
    }


def confusion_rows(scored: pd.DataFrame, roles: Iterable[str]) -> list[dict[str, object]]:
    """Rows of `CONFUSION_SCHEMA`: each type, and each role with the mean over types.

    Args:
        scored: of `table3.score`, one row per object and task.
        roles: of each row, see :func:`touched_role`.
    """
    occurs = scored[list(LABELS)].to_numpy(dtype=bool)
    chance = scored[list(OCCURS)].to_numpy()
    similarity = scored["similarity"].to_numpy()
    rows = [
        _confusion(("type", name), occurs[:, [k]], chance[:, [k]], similarity[occurs[:, k]])
        for k, name in enumerate(TYPES)
    ]
    of_row = np.array(list(roles))
    for name in sorted(set(of_row)):
        mine = of_row == name
        rows.append(_confusion(("role", name), occurs[mine], chance[mine], similarity[mine]))
    return rows


def _confusion(
    what: tuple[str, str], occurs: np.ndarray, chance: np.ndarray, similarity: np.ndarray
) -> dict[str, object]:
    chosen = chance > SIGMOID_THRESHOLD
    both = (occurs & chosen).sum()
    return {
        "by": what[0],
        "name": what[1],
        "samples": len(occurs),
        "occurs": round(occurs.mean(), 4),
        "predicted": round(chance.mean(), 4),
        "found": round(both / occurs.sum(), 4) if occurs.any() else np.nan,
        "right": round(both / chosen.sum(), 4) if chosen.any() else np.nan,
        "similarity": round(similarity.mean(), 4) if len(similarity) else np.nan,
    }


def touched_role(roles: Iterable[str], task: Task) -> str:
    """Of the roles of an object's parts, the one that people touch most for a task."""
    return max(sorted(set(roles)), key=lambda role: task.touched.get(role, 0.0))


def looked_at(scored: pd.DataFrame, count: int) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The `count` worst rows, one per object, and as many from the worst to the best.

    Args:
        scored: of `table3.score`, one row per object and task.
    """
    ordered = scored.sort_values(["similarity", "object", "task"], ignore_index=True)
    worst = ordered.drop_duplicates("object").head(count)
    rest = ordered[~ordered["object"].isin(worst["object"])].drop_duplicates("object")
    places = np.linspace(0, len(rest) - 1, min(count, len(rest))).round().astype(int)
    return worst, rest.iloc[places]
