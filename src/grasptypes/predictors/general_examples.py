"""Examples of the predictor for unseen objects, and which of them are held out together."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS, LABELS
from grasptypes.predictors.families import Families
from grasptypes.predictors.general_inputs import FACTS, Inputs, Pictures, Targets, TaskCode
from grasptypes.settings.tasks import Task


@dataclass(frozen=True)
class Known:
    """Everything there is to learn from.

    Attributes:
        pictures: of all objects.
        facts: index object, columns `general_inputs.FACTS`.
        samples: of :mod:`grasptypes.labels.samples`, for any number of objects and tasks.
        families: of each object.
        tasks: that occur in the samples.
    """

    pictures: Pictures
    facts: pd.DataFrame
    samples: pd.DataFrame
    families: Families
    tasks: Mapping[str, Task]

    def without(self, families: Collection[str]) -> Known:
        """What is left without all objects of some families."""
        kept = [name for name in self.facts.index if not self.families[name] & set(families)]
        return self.only(kept)

    def without_labels(self, families: Collection[str], task: str) -> Known:
        """What is left without the labels that all objects of some families have for a task."""
        out = [bool(self.families[name] & set(families)) for name in self.samples["object"]]
        samples = self.samples[~(np.array(out) & (self.samples["task"] == task))]
        return replace(self, samples=samples)

    def only(self, names: Collection[str]) -> Known:
        """What is known of some objects."""
        samples = self.samples[self.samples["object"].isin(names)]
        facts = self.facts[self.facts.index.isin(names)]
        return Known(self.pictures.of(names), facts, samples, self.families, self.tasks)

    def examples(self, code: TaskCode) -> tuple[Inputs, Targets]:
        """One example per image and task that has a label; all labels weigh the same.

        Raises:
            InputError: an object has labels, but no images.
        """
        places = [np.flatnonzero(self.pictures.objects == name) for name in self.samples["object"]]
        counts = np.array([len(place) for place in places])
        if not counts.all():
            missing = self.samples["object"].iloc[int(np.argmin(counts))]
            raise InputError("data/general", str(missing), "has labels, but no images")
        rows = np.repeat(np.arange(len(self.samples)), counts)
        tasks = self.samples["task"].to_numpy()[rows]
        shown = self.pictures.rows(np.concatenate(places))
        targets = Targets(
            self.samples[list(LABELS)].to_numpy(dtype=float)[rows],
            frequencies(self.samples)[rows],
            1 / counts[rows],
            self.samples["object"].to_numpy()[rows],
        )
        return asked(shown, self.facts, [self.tasks[name] for name in tasks], code), targets


def asked(pictures: Pictures, facts: pd.DataFrame, tasks: Sequence[Task], code: TaskCode) -> Inputs:
    """The inputs for images (N,) of known objects and a task for each."""
    return Inputs(
        pictures.features,
        pictures.classes,
        facts.reindex(pictures.objects)[list(FACTS)].to_numpy(dtype=float),
        np.stack([code(task) for task in tasks]),
        np.ones(len(pictures.objects)),
    )


def frequencies(samples: pd.DataFrame) -> np.ndarray:
    """Shares (N, types) of the types among the valid grasps of each sample."""
    counts = samples[list(COUNTS)].to_numpy(dtype=float)
    return np.asarray(counts / counts.sum(axis=1, keepdims=True))
