"""The protocol of Table III: kinds, the paper's objects and their scans, known and held out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

from grasptypes.predictors.general_baseline import Test, task_vector_answers
from grasptypes.predictors.general_examples import Families, Known
from grasptypes.predictors.general_inputs import Pictures, joined
from grasptypes.predictors.general_protocol import (
    KINDS,
    OBJECTS,
    SCANS,
    SCANS_KNOWN,
    SIMULATED,
    Heads,
    answers,
    calibrated_folds,
    finished,
    hold_out_kinds,
    temperatures,
)
from grasptypes.settings.general import GeneralSettings
from grasptypes.settings.predictors import PredictorSettings


@dataclass(frozen=True)
class Study:
    """All data of the protocol.

    Attributes:
        kinds: randomised images, sizes and labels of kinds.
        objects: those of the paper's objects, with simulated labels.
        renders: of the paper's objects, as its models see them.
        scans: images of real scans of these objects; may be empty.
        samples: labels of the objects by source.
    """

    kinds: Known
    objects: Known
    renders: Pictures
    scans: Pictures
    samples: Mapping[str, pd.DataFrame]

    def everything(self) -> Known:
        """Kinds and objects together."""
        families: Families = {**self.kinds.families, **self.objects.families}
        return Known(
            joined([self.kinds.pictures, self.objects.pictures]),
            pd.concat([self.kinds.facts, self.objects.facts]),
            pd.concat([self.kinds.samples, self.objects.samples], ignore_index=True),
            families,
            self.kinds.tasks,
        )

    def groups(self) -> dict[frozenset[str], list[str]]:
        """The objects of each set of families, which are tested with the same heads."""
        found: dict[frozenset[str], list[str]] = {}
        for name in self.objects.facts.index:
            found.setdefault(self.objects.families[name], []).append(name)
        return found


def answer_everything(
    study: Study, settings: GeneralSettings, baseline: PredictorSettings, seed: int
) -> pd.DataFrame:
    """The answers of all models in all columns: a table of `general_protocol.ANSWER_SCHEMA`.

    Temperatures come from kinds alone, with heads that have not learned from the objects.
    """
    folds = hold_out_kinds(study.kinds, settings.head, settings.protocol.folds, seed)
    heat = temperatures(pd.concat(folds), study.kinds.samples)
    tables = [calibrated_folds(folds, study.kinds.samples)]
    everything, facts, tasks = study.everything(), study.objects.facts, study.kinds.tasks
    tests = first_views(study.renders, settings.protocol.test_views)
    for out, names in study.groups().items():
        heads = Heads.of(everything.without(out), settings.head)
        for shown, pictures in ((OBJECTS, tests), (SCANS, study.scans)):
            if len(pictures.of(names).objects):
                told = answers(heads, pictures.of(names), facts, tasks)
                tables.append(finished(told, heat, shown, SIMULATED))
    if len(study.scans.objects):
        heads = Heads.of(everything, settings.head)
        told = answers(heads, study.scans, facts, tasks)
        tables.append(finished(told, heat, SCANS_KNOWN, SIMULATED))
    tables += _of_baseline(study, tests, baseline, seed)
    return pd.concat(tables, ignore_index=True)


def first_views(pictures: Pictures, count: int) -> Pictures:
    """The first images of each object."""
    place = pd.Series(pictures.objects).groupby(pictures.objects).cumcount()
    return pictures.rows(place.to_numpy() < count)


def _of_baseline(
    study: Study, tests: Pictures, settings: PredictorSettings, seed: int
) -> list[pd.DataFrame]:
    """The answers of the paper's model (b), for each source of labels."""
    nobody: frozenset[str] = frozenset()
    asked: list[tuple[str, Test]] = [(KINDS, _test(nobody, study.kinds.pictures))]
    if len(study.scans.objects):
        asked.append((SCANS_KNOWN, _test(nobody, study.scans)))
    for families, names in study.groups().items():
        relatives = frozenset(
            name for name, own in study.objects.families.items() if own & families
        )
        asked.append((OBJECTS, _test(relatives, tests.of(names))))
        if len(study.scans.of(names).objects):
            asked.append((SCANS, _test(relatives, study.scans.of(names))))
    renders = study.renders.features, study.renders.objects
    tables = []
    for source, samples in study.samples.items():
        told = task_vector_answers(renders, samples, [test for _, test in asked], settings, seed)
        tables += [
            _named(table, shown, source) for (shown, _), table in zip(asked, told, strict=True)
        ]
    return tables


def _test(out: frozenset[str], pictures: Pictures) -> Test:
    return out, pictures.features, np.asarray(pictures.objects)


def _named(table: pd.DataFrame, shown: str, source: str) -> pd.DataFrame:
    """A baseline's table with its column and label source; it has no answer from all views."""
    whole = finished(table, {}, shown, source)
    return whole[whole["model"].isin(set(table["model"]))]
