"""Models that are told one of many tasks in one way or another, on the same images and folds.

An object has only the tasks that it affords. A model learns from the pairs of objects and tasks of
the training images, and is tested on the pairs of the others: with the first 2, 4, ... tasks, and
on each task that it has not learnt from.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS
from grasptypes.predictors.demonstrations import Demonstrations, beside, shown_beside
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.film import try_film
from grasptypes.predictors.members import Member, members_by_group
from grasptypes.predictors.metrics import METRICS, measures, shares
from grasptypes.predictors.task_inputs import affordance_vectors, one_hot
from grasptypes.predictors.told import MODELS, UNSEEN_TASK_MODELS
from grasptypes.predictors.training import fit, predict
from grasptypes.seeds import rng
from grasptypes.settings.many_tasks import ManyTaskSettings
from grasptypes.settings.predictors import NO_TASK, PredictorSettings
from grasptypes.settings.tasks import read_tasks

Inputs = Mapping[str, Mapping[str, np.ndarray]]


@dataclass(frozen=True)
class ManyTasks:
    """What all models learn from.

    Attributes:
        samples: of :mod:`grasptypes.labels.samples`, one row per object and task that it affords.
        folds: of :mod:`grasptypes.predictors.folds`.
        inputs: object to encoding (no task, and each task that it affords) to (V, F) features.
        demonstrations: of every object and task; None if no model is shown the task.
        settings: of the study.
        training: of all heads.
        missing: share of the training examples without a demonstration.
        seed: of the workflow.
    """

    samples: pd.DataFrame
    folds: pd.DataFrame
    inputs: Inputs
    demonstrations: Demonstrations | None
    settings: ManyTaskSettings
    training: PredictorSettings
    missing: float
    seed: int

    def examples(self, model: str, number: int) -> Examples:
        """The examples of a model with the first tasks, demonstrations not included."""
        tasks = list(self.settings.tasks[:number])
        known = self.samples[self.samples["task"].isin(tasks)]
        rows, parts, counts = [], [], []
        for sample in known.sort_values(["object", "task"]).to_dict("records"):
            name, task = sample["object"], sample["task"]
            group = self.folds[(self.folds["object"] == name)].sort_values("view")
            group = group[group["view"] < self.settings.views]
            encoding = task if model == "task_in_image" else NO_TASK
            rows.append(group.assign(task=task))
            parts.append(self._features(name, encoding, group["view"].to_numpy()))
            counts.append(np.tile([sample[count] for count in COUNTS], (len(group), 1)))
        index = pd.concat(rows, ignore_index=True)[["object", "view", "task", "fold"]]
        numbers = np.concatenate(counts)
        label, frequencies = np.asarray(numbers > 0, dtype=np.float32), shares(numbers)
        told = self._vectors(model, tasks)
        vectors = None if told is None else told[index["task"].map(tasks.index)]
        inputs = np.concatenate(parts)
        return Examples(index, inputs, vectors, label, shares(label), frequencies)

    def _vectors(self, model: str, tasks: Sequence[str]) -> np.ndarray | None:
        if model in ("task_vector", "film"):
            return one_hot(tasks)
        if model in ("affordance_vector", "film_affordance"):
            return affordance_vectors([read_tasks()[task] for task in tasks])
        return None

    def _features(self, name: str, encoding: str, views: np.ndarray) -> np.ndarray:
        if encoding not in self.inputs.get(name, {}):
            raise InputError(f"data/many_tasks/features/{name}.npz", encoding, "is missing")
        features: np.ndarray = self.inputs[name][encoding][views]
        return features

    def with_known_tasks(self, model: str, number: int) -> pd.DataFrame:
        """Test on held-out images: a row for each fold, seed, object and task."""
        examples = self.examples(model, number)
        members = members_by_group(examples.index["fold"], self.training.seeds)
        return self._tried(model, examples, members).assign(split="views", tasks=number)

    def with_unseen_tasks(self, model: str) -> pd.DataFrame:
        """Test on each task in turn, which is not learnt from, and on held-out images (fold 0)."""
        number = max(self.settings.numbers)
        examples = self.examples(model, number)
        tested = (examples.index["fold"] == 0).to_numpy()
        task = examples.index["task"].to_numpy()
        members = [
            Member(name, k, np.flatnonzero(~own & ~tested), np.flatnonzero(own & tested))
            for k in range(self.training.seeds)
            for name in self.settings.tasks[:number]
            for own in [task == name]
        ]
        return self._tried(model, examples, members).assign(split="tasks", tasks=number)

    def _tried(self, model: str, examples: Examples, members: Sequence[Member]) -> pd.DataFrame:
        """A row for each member, and object and task of its test."""
        key = ("many tasks", model, self.seed)
        learnt, tested = examples, examples
        if model == "demonstration":
            learnt, tested = self._beside_demonstrations(examples, key)
        if model in ("film", "film_affordance"):
            logits = try_film(learnt, members, self.training, key, self.settings.embedding)
        else:
            heads, _ = fit(learnt, members, self.training, key)
            logits = [predict(heads, k, tested, member.test) for k, member in enumerate(members)]
        tables = []
        for member, outputs in zip(members, logits, strict=True):
            rows = member.test
            found = measures(outputs, tested.labels[rows], tested.frequencies[rows])
            pairs = examples.index.iloc[rows][["object", "task"]].reset_index(drop=True)
            groups = pd.concat([pairs, pd.DataFrame(found)], axis=1).groupby(["object", "task"])
            means = groups[list(METRICS)].mean().assign(n_test=groups.size())
            tables.append(means.reset_index().assign(group=member.group, seed=member.seed))
        return pd.concat(tables, ignore_index=True).assign(model=model)

    def _beside_demonstrations(
        self, examples: Examples, key: tuple[str | int, ...]
    ) -> tuple[Examples, Examples]:
        """Examples to learn from, some without a demonstration, and to be tested on."""
        if self.demonstrations is None:
            raise ValueError("no demonstrations")
        shown, folds = self.demonstrations, self.folds["fold"].nunique()
        index = shown.index.assign(fold=shown.index["view"] % folds)
        rows = shown_beside(examples.index, index, False, rng(*key, "right"))
        second = shown.features[rows]
        hidden = rng(*key, "missing").random(len(second)) < self.missing
        return (
            beside(examples, np.where(hidden[:, None], 0, second)),
            beside(examples, second),
        )


def try_model(problem: ManyTasks, model: str) -> pd.DataFrame:
    """All trials of a model: a table of :data:`many_task_tables.TRIAL_SCHEMA`.

    Raises:
        ValueError: there is no such model.
    """
    if model not in MODELS:
        raise ValueError(f"'{model}' is not one of {', '.join(MODELS)}")
    tables = [problem.with_known_tasks(model, number) for number in problem.settings.numbers]
    if model in UNSEEN_TASK_MODELS:
        tables.append(problem.with_unseen_tasks(model))
    return pd.concat(tables, ignore_index=True)
