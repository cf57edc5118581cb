"""The paper's model (b) on objects held out with their relatives, next to the general predictor."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from scipy.special import expit, softmax

from grasptypes.labels.samples import LABELS
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.general_protocol import TASK_VECTOR, answer_table
from grasptypes.predictors.members import Member
from grasptypes.predictors.training import fit, predict
from grasptypes.settings.predictors import PredictorSettings

# What is asked: the objects left out of training, and the images (N, F) with their objects (N,).
Asked = tuple[frozenset[str], np.ndarray, np.ndarray]


def task_vector_answers(
    renders: tuple[np.ndarray, np.ndarray],
    samples: pd.DataFrame,
    tests: Sequence[Asked],
    settings: PredictorSettings,
    seed: int,
) -> list[pd.DataFrame]:
    """Answers of model (b) for each test; one head per set of objects left out.

    Args:
        renders: features (N, F) of the backbone, and the object in each image (N,).
        samples: labels of these objects; its tasks are those of the task vector.
    """
    tasks = sorted(set(samples["task"]))
    inputs, objects = renders
    taught = np.isin(objects, samples["object"])
    features = [inputs[taught], *(shown for _, shown, _ in tests)]
    names = [objects[taught], *(shown for _, _, shown in tests)]
    origin = np.repeat(np.arange(len(names)), [len(part) for part in names])
    examples = _examples(np.concatenate(features), np.concatenate(names), origin, tasks, samples)
    index = examples.index
    left_out = list(dict.fromkeys(out for out, _, _ in tests))
    members = [
        Member(
            str(number),
            0,
            np.flatnonzero((index["origin"] == 0) & ~index["object"].isin(out)),
            np.flatnonzero(
                index["origin"].isin([i + 1 for i, t in enumerate(tests) if t[0] == out])
            ),
        )
        for number, out in enumerate(left_out)
    ]
    heads, _ = fit(examples, members, settings, ("general", "task_vector", seed))
    tables = [
        _table(index.iloc[member.test], predict(heads, number, examples, member.test))
        for number, member in enumerate(members)
    ]
    table = pd.concat(tables)
    return [
        table[table["origin"] == number + 1].drop(columns="origin") for number in range(len(tests))
    ]


def _examples(
    features: np.ndarray,
    names: np.ndarray,
    origin: np.ndarray,
    tasks: Sequence[str],
    samples: pd.DataFrame,
) -> Examples:
    """Every image with every task; images of a test have no label."""
    label_of = samples.set_index(["object", "task"])[list(LABELS)]
    view = pd.Series(names).groupby([names, origin]).cumcount().to_numpy()
    index = pd.concat(
        pd.DataFrame({"object": names, "view": view, "task": task, "origin": origin})
        for task in tasks
    ).reset_index(drop=True)
    pairs = pd.MultiIndex.from_frame(index[["object", "task"]])
    # A copy: torch needs arrays that may be written.
    labels = np.array(label_of.reindex(pairs).fillna(0), dtype=np.float32)
    sets = labels / np.maximum(labels.sum(axis=1, keepdims=True), 1)
    vectors = index["task"].to_numpy()[:, None] == np.array(tasks)
    return Examples(
        index,
        np.tile(features.astype(np.float32), (len(tasks), 1)),
        vectors.astype(np.float32),
        labels,
        sets,
        sets,  # only sets are learnt and compared here
    )


def _table(where: pd.DataFrame, logits: np.ndarray) -> pd.DataFrame:
    """Answers in the paper's sense: types by the logistic function, their vector by the softmax."""
    vectors = softmax(logits, axis=1)
    return answer_table(TASK_VECTOR, where, expit(logits), vectors, vectors)
