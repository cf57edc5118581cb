"""Answers of the predictor for unseen objects, and of simpler ones, about objects held out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.labels.samples import LABELS, TYPES
from grasptypes.predictors.families import family_folds
from grasptypes.predictors.general import GeneralHead, fit_head
from grasptypes.predictors.general_examples import Known, asked, frequencies
from grasptypes.predictors.general_inputs import FACTS, Pictures, TaskCode
from grasptypes.seeds import rng
from grasptypes.settings.general import HeadSettings
from grasptypes.settings.tasks import Task

OCCURS, DIRECTION, SHARES = (
    tuple(f"{word}_{name}" for name in TYPES) for word in ("occurs", "direction", "share")
)
ALL_VIEWS = -1
CONSTANT, SIZE_ONLY, GEOMETRY, TASK_VECTOR, IMAGE, WITH_SIZE, VIEWS, VIEWS_WITH_SIZE = ROWS = (
    "constant",
    "size_only",
    "geometry",
    "task_vector",
    "general",
    "general_size",
    "general_views",
    "general_views_size",
)
SIMULATED = "simulated"
KINDS_KNOWN, KINDS, KIND_TASKS, OBJECTS, SCANS_KNOWN, SCANS, PHOTOGRAPHS_KNOWN, PHOTOGRAPHS = (
    COLUMNS
) = (
    "kinds_known",
    "kinds",
    "kind_tasks",
    "objects",
    "scans_known",
    "scans",
    "photographs_known",
    "photographs",
)

_SHARE = pa.Check.in_range(0, 1)
ANSWER_SCHEMA = pa.DataFrameSchema(
    {
        "shown": pa.Column(str, pa.Check.isin(COLUMNS)),
        "model": pa.Column(str, pa.Check.isin(ROWS)),
        "labels": pa.Column(str, description="learned from"),
        "object": pa.Column(str),
        "task": pa.Column(str),
        "view": pa.Column(int, pa.Check.ge(ALL_VIEWS), description="-1: all views together"),
        **{name: pa.Column(float, _SHARE) for name in (*OCCURS, *DIRECTION, *SHARES)},
    },
    strict=True,
    ordered=True,
    unique=["shown", "model", "labels", "object", "task", "view"],
)


@dataclass(frozen=True)
class Heads:
    """What one training set gives: the head with all inputs, that without images, the constant.

    Attributes:
        constant: (2, types) mean of the labels, and of the frequencies.
    """

    code: TaskCode
    whole: GeneralHead
    size_only: GeneralHead
    constant: np.ndarray

    @classmethod
    def of(cls, known: Known, settings: HeadSettings) -> Heads:
        """Train on everything that is known."""
        code = TaskCode.of(known.tasks)
        inputs, targets = known.examples(code)
        forgetful = settings.memory.changed(last_features=0)
        blind = settings.changed(pictures=0, classes=0, memory=forgetful)
        means = known.samples[list(LABELS)].mean().to_numpy(), frequencies(known.samples).mean(0)
        return cls(
            code,
            fit_head(inputs, targets, settings),
            fit_head(inputs, targets, blind),
            np.stack(means),
        )


def answers(
    heads: Heads, shown: Pictures, facts: pd.DataFrame, tasks: Mapping[str, Task]
) -> pd.DataFrame:
    """Answers of all models about images of objects: a table of :data:`ANSWER_SCHEMA`, in part.

    Args:
        facts: of the objects; index object. If all are NaN, models that need them do not answer.
        tasks: to ask for.
    """
    numbers = pd.Series(shown.objects).groupby(shown.objects).cumcount().to_numpy()
    parts = []
    for name, task in tasks.items():
        inputs = asked(shown, facts, [task] * len(shown.objects), heads.code)
        where = pd.DataFrame({"object": shown.objects, "task": name, "view": numbers})
        constant = np.tile(heads.constant[:, None], (1, len(inputs), 1))
        together = inputs.together(shown.objects)
        objects = where.drop_duplicates("object").sort_values("object").assign(view=ALL_VIEWS)
        told = {
            CONSTANT: (where, (constant[0], constant[1])),
            IMAGE: (where, heads.whole.answers(inputs.without(FACTS))),
            VIEWS: (objects, heads.whole.answers(together.without(FACTS))),
        }
        if np.isfinite(inputs.facts).any():
            told[SIZE_ONLY] = where, heads.size_only.answers(inputs)
            told[WITH_SIZE] = where, heads.whole.answers(inputs)
            told[VIEWS_WITH_SIZE] = objects, heads.whole.answers(together)
        parts += [answer_table(model, rows, *answer) for model, (rows, answer) in told.items()]
    return pd.concat(parts, ignore_index=True)


def answer_table(
    model: str,
    where: pd.DataFrame,
    occurs: np.ndarray,
    shares: np.ndarray,
    direction: np.ndarray | None = None,
) -> pd.DataFrame:
    """One row per row of `where`.

    Args:
        direction: (N, types) compared with the set of types; default: `occurs`, normalised.
    """
    if direction is None:
        direction = occurs / occurs.sum(axis=1, keepdims=True)
    numbers = np.hstack([occurs, direction, shares])
    columns = [*OCCURS, *DIRECTION, *SHARES]
    table = pd.DataFrame(numbers, columns=columns, index=where.index)
    return pd.concat([where.assign(model=model), table], axis=1)


def finished(table: pd.DataFrame, shown: str, labels: str) -> pd.DataFrame:
    """Answers as a table of :data:`ANSWER_SCHEMA`.

    Args:
        table: of :func:`answers`.
        shown: name of the column.
        labels: source of the labels learned from.
    """
    return table.assign(shown=shown, labels=labels)[list(ANSWER_SCHEMA.columns)]


def hold_out_kinds(known: Known, settings: HeadSettings, folds: int, seed: int) -> pd.DataFrame:
    """Answers about kinds whose families were held out."""
    found = []
    for fold in family_folds(known.families, folds, seed):
        test = known.only([name for name in known.facts.index if known.families[name] & fold])
        heads = Heads.of(known.without(fold), settings)
        found.append(answers(heads, test.pictures, test.facts, known.tasks))
    return finished(pd.concat(found, ignore_index=True), KINDS, SIMULATED)


def hold_out_tasks(known: Known, settings: HeadSettings, folds: int, seed: int) -> pd.DataFrame:
    """As :func:`hold_out_kinds`, but of what is held out, only the labels of one task at a time."""
    found = []
    for fold in family_folds(known.families, folds, seed):
        test = known.only([name for name in known.facts.index if known.families[name] & fold])
        for name, task in known.tasks.items():
            heads = Heads.of(known.without_labels(fold, name), settings)
            found.append(answers(heads, test.pictures, test.facts, {name: task}))
    return finished(pd.concat(found, ignore_index=True), KIND_TASKS, SIMULATED)


def hold_out_images(
    known: Known, settings: HeadSettings, spread: np.ndarray, seed: int
) -> pd.DataFrame:
    """Answers about every second image of known kinds, as of other objects of the same kinds.

    Args:
        spread: (4,) standard deviations by which their sizes and masses differ.
    """
    place = pd.Series(known.pictures.objects).groupby(known.pictures.objects).cumcount().to_numpy()
    heads = Heads.of(replace(known, pictures=known.pictures.rows(place % 2 == 0)), settings)
    other = known.facts + np.stack(
        [
            spread * rng("another object", name, seed).normal(size=len(FACTS))
            for name in known.facts.index
        ]
    )
    told = answers(heads, known.pictures.rows(place % 2 == 1), other, known.tasks)
    return finished(told, KINDS_KNOWN, SIMULATED)
