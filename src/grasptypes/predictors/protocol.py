"""The paper's protocol (section IV-A): train and test all splits and seeds, then train on all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from grasptypes.predictors.backbone import Backbone
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.finetuning import fine_tune, predict_pictures
from grasptypes.predictors.members import Member
from grasptypes.predictors.predictor import BatchedMLP
from grasptypes.predictors.scoring import curve_table, score
from grasptypes.predictors.training import fit, predict
from grasptypes.settings.predictors import PredictorSettings


@dataclass(frozen=True)
class Outcome:
    """Tables of a set of splits; schemas are in :mod:`grasptypes.predictors.scoring`."""

    metrics: pd.DataFrame
    curves: pd.DataFrame
    predictions: pd.DataFrame


def try_splits(
    examples: Examples,
    members: Sequence[Member],
    settings: PredictorSettings,
    key: tuple[str | int, ...],
    backbone: Backbone | None = None,
) -> Outcome:
    """Train and test one predictor per member.

    Args:
        examples: with features as inputs if the backbone is frozen, else images.
        key: name of the computation, for its random numbers.
        backbone: backbone to fine-tune; None if it is frozen.
    """
    if backbone is None:
        heads, curves = fit(examples, members, settings, key)
        logits = [predict(heads, k, examples, member.test) for k, member in enumerate(members)]
    else:
        curves, logits = _test_fine_tuned(examples, members, settings, key, backbone)
    metrics, predictions = score(examples, members, logits)
    return Outcome(metrics, curve_table(members, curves), predictions)


def train_final(
    examples: Examples,
    settings: PredictorSettings,
    key: tuple[str | int, ...],
    backbone: Backbone | None = None,
) -> tuple[BatchedMLP, Backbone | None]:
    """The final predictor, trained on all examples, and its backbone if fine-tuned."""
    everything = Member("all", 0, np.arange(len(examples.inputs)), np.arange(0))
    if backbone is None:
        return fit(examples, [everything], settings, key)[0], None
    network, _ = fine_tune(backbone, examples, everything, settings, key)
    return network.head, network.backbone


def _test_fine_tuned(
    examples: Examples,
    members: Sequence[Member],
    settings: PredictorSettings,
    key: tuple[str | int, ...],
    backbone: Backbone,
) -> tuple[np.ndarray, list[np.ndarray]]:
    curves = np.full((settings.finetuning.epochs, len(members), 2), np.nan)
    logits = []
    for number, member in enumerate(members):
        network, losses = fine_tune(backbone, examples, member, settings, key)
        curves[:, number, 0] = losses
        logits.append(predict_pictures(network, examples, member.test, settings.finetuning.batch))
    return curves, logits
