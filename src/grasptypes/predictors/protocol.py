"""The paper's protocol (section IV-A): train on all splits and seeds, test, train once on all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import pandas as pd

from grasptypes.predictors.backbone import Backbone
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.finetuning import FineTuning, fine_tune, predict_pictures
from grasptypes.predictors.predictor import Heads
from grasptypes.predictors.predictor_files import FROZEN
from grasptypes.predictors.scoring import curve_table, score
from grasptypes.predictors.training import Member, Schedule, fit, predict


@dataclass(frozen=True)
class Recipe:
    """How predictors are trained.

    Attributes:
        schedule: of the head.
        tuning: of the backbone.
    """

    schedule: Schedule
    tuning: FineTuning

    @property
    def frozen(self) -> bool:
        """Whether the backbone stays as it is, so that its features can be computed beforehand."""
        return self.tuning.finetune == FROZEN


def recipe_of(settings: Mapping[str, Any]) -> Recipe:
    """The recipe that the ``predictors`` section of params.yaml describes."""
    schedule = {field.name: settings[field.name] for field in fields(Schedule)}
    schedule["hidden"] = tuple(schedule["hidden"])
    return Recipe(
        Schedule(**schedule), FineTuning(finetune=settings["finetune"], **settings["finetuning"])
    )


@dataclass(frozen=True)
class Outcome:
    """Tables of a set of splits; schemas are in :mod:`grasptypes.predictors.scoring`."""

    metrics: pd.DataFrame
    curves: pd.DataFrame
    predictions: pd.DataFrame


def try_splits(
    examples: Examples,
    members: Sequence[Member],
    recipe: Recipe,
    key: tuple[str | int, ...],
    backbone: Backbone | None = None,
) -> Outcome:
    """Train and test one predictor a member.

    Args:
        examples: features as inputs if the recipe is frozen, else pictures.
        key: names the computation for its random numbers.
        backbone: to be fine-tuned; only for a recipe that is not frozen.
    """
    if recipe.frozen:
        heads, curves = fit(examples, members, recipe.schedule, key)
        logits = [predict(heads, k, examples, member.test) for k, member in enumerate(members)]
    else:
        curves, logits = _test_fine_tuned(examples, members, recipe, key, _given(backbone))
    metrics, predictions = score(examples, members, logits)
    return Outcome(metrics, curve_table(members, curves), predictions)


def train_final(
    examples: Examples,
    recipe: Recipe,
    key: tuple[str | int, ...],
    backbone: Backbone | None = None,
) -> tuple[Heads, Backbone | None]:
    """The predictor that is handed out, trained on all examples; its backbone if that changed."""
    everything = Member("all", 0, np.arange(len(examples.inputs)), np.arange(0))
    if recipe.frozen:
        return fit(examples, [everything], recipe.schedule, key)[0], None
    network, _ = fine_tune(
        _given(backbone), examples, everything, recipe.schedule, recipe.tuning, key
    )
    return network.head, network.backbone


def _test_fine_tuned(
    examples: Examples,
    members: Sequence[Member],
    recipe: Recipe,
    key: tuple[str | int, ...],
    backbone: Backbone,
) -> tuple[np.ndarray, list[np.ndarray]]:
    curves = np.full((recipe.tuning.epochs, len(members), 2), np.nan)
    logits = []
    for number, member in enumerate(members):
        network, losses = fine_tune(backbone, examples, member, recipe.schedule, recipe.tuning, key)
        curves[:, number, 0] = losses
        logits.append(predict_pictures(network, examples, member.test, recipe.tuning.batch))
    return curves, logits


def _given(backbone: Backbone | None) -> Backbone:
    if backbone is None:
        raise ValueError("fine-tuning needs a backbone")
    return backbone
