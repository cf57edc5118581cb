"""The protocol of Table III: kinds, the paper's objects, their scans, and photographs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from grasptypes.predictors.families import Families
from grasptypes.predictors.general import GeneralHead
from grasptypes.predictors.general_baseline import Asked, task_vector_answers
from grasptypes.predictors.general_examples import Known
from grasptypes.predictors.general_inputs import Pictures, TaskCode, joined
from grasptypes.predictors.general_protocol import (
    GEOMETRY,
    KINDS,
    SIMULATED,
    WITH_SIZE,
    Heads,
    answers,
    finished,
    hold_out_kinds,
    hold_out_tasks,
)
from grasptypes.settings.general import HeadSettings
from grasptypes.settings.predictors import PredictorSettings

NOTHING: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Test:
    """Images of objects that all models answer for.

    Attributes:
        shown: name of the column.
        pictures: of all objects.
        facts: what is said of their size and mass; index object, NaN where nothing is.
        families: of each object.
        held_out: whether the families of an object are left out of what is learned.
    """

    shown: str
    pictures: Pictures
    facts: pd.DataFrame
    families: Families
    held_out: bool

    def groups(self) -> dict[frozenset[str], list[str]]:
        """The objects that are tested with the same heads, by the families that are left out."""
        found: dict[frozenset[str], list[str]] = {}
        for name in dict.fromkeys(self.pictures.objects.tolist()):
            found.setdefault(self.families[name] if self.held_out else NOTHING, []).append(name)
        return found


@dataclass(frozen=True)
class Study:
    """All data of the protocol.

    Attributes:
        kinds: randomised images, sizes and labels of kinds.
        objects: those of the paper's objects, with simulated labels.
        renders: of the paper's objects, as its models see them.
        tests: everything that is tested but the kinds, which are held out in folds.
        samples: labels of the objects by source.
    """

    kinds: Known
    objects: Known
    renders: Pictures
    tests: Sequence[Test]
    samples: Mapping[str, pd.DataFrame]


def together(kinds: Known, objects: Known) -> Known:
    """All examples of kinds and objects."""
    families: Families = {**kinds.families, **objects.families}
    return Known(
        joined([kinds.pictures, objects.pictures]),
        pd.concat([kinds.facts, objects.facts]),
        pd.concat([kinds.samples, objects.samples], ignore_index=True),
        families,
        kinds.tasks,
    )


def answer_everything(study: Study, head: HeadSettings, folds: int, seed: int) -> pd.DataFrame:
    """The answers of the heads about what is held out: a table of `general_protocol.ANSWER_SCHEMA`.

    Args:
        folds: groups of kinds, each held out in turn.
    """
    tables = [
        hold_out_kinds(study.kinds, head, folds, seed),
        hold_out_tasks(study.kinds, head, folds, seed),
    ]
    everything, tasks = together(study.kinds, study.objects), study.kinds.tasks
    heads: dict[frozenset[str], Heads] = {}
    for test in study.tests:
        for out, names in test.groups().items():
            if out not in heads:
                heads[out] = Heads.of(everything.without(out), head)
            told = answers(heads[out], test.pictures.of(names), test.facts, tasks)
            tables.append(finished(told, test.shown, SIMULATED))
    return pd.concat(tables, ignore_index=True)


def answer_by_shape(study: Study, head: HeadSettings, folds: int, seed: int) -> pd.DataFrame:
    """The answers of heads that are told shape, size and mass, and see no image.

    Args:
        study: with shapes, see `general_shapes`, in the place of images.
    """
    told = answer_everything(study, head, folds, seed)
    return told[told["model"] == WITH_SIZE].assign(model=GEOMETRY)


def final_head(
    kinds: Known, objects: Known, settings: HeadSettings
) -> tuple[GeneralHead, TaskCode]:
    """The head that has learned from everything."""
    heads = Heads.of(together(kinds, objects), settings)
    return heads.whole, heads.code


def first_views(pictures: Pictures, count: int) -> Pictures:
    """The first images of each object."""
    place = pd.Series(pictures.objects).groupby(pictures.objects).cumcount()
    return pictures.rows(place.to_numpy() < count)


def answer_as_paper(study: Study, settings: PredictorSettings, seed: int) -> pd.DataFrame:
    """The answers of the paper's model (b), for each source of labels."""
    own, shown = study.objects.families, [KINDS]
    asked: list[Asked] = [(NOTHING, study.kinds.pictures.features, study.kinds.pictures.objects)]
    for test in study.tests:
        for out, names in test.groups().items():
            relatives = frozenset(name for name, families in own.items() if families & out)
            pictures = test.pictures.of(names)
            shown.append(test.shown)
            asked.append((relatives, pictures.features, pictures.objects))
    renders = study.renders.features, study.renders.objects
    tables = []
    for source, samples in study.samples.items():
        told = task_vector_answers(renders, samples, asked, settings, seed)
        tables += [finished(table, name, source) for name, table in zip(shown, told, strict=True)]
    return pd.concat(tables, ignore_index=True)
