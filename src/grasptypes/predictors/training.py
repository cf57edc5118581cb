"""Training of heads on frozen features, for all folds and seeds of a table at once."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member
from grasptypes.predictors.predictor import Architecture, BatchedMLP, loss
from grasptypes.seeds import rng
from grasptypes.settings.predictors import PredictorSettings

LOGGER = logging.getLogger("grasptypes")


def fit(
    examples: Examples,
    members: Sequence[Member],
    settings: PredictorSettings,
    key: tuple[str | int, ...],
) -> tuple[BatchedMLP, np.ndarray]:
    """Train one head per member.

    The first layer is trained in the leading principal directions of each member's own training
    features and then converted to take the features themselves: a change of coordinates that makes
    training several times faster and keeps four layers. All heads use as many directions and as
    many steps per epoch as the smallest training split allows.

    Args:
        examples: with features as inputs.
        members: heads to train.
        settings: training settings.
        key: name of the computation, for its random numbers.

    Returns:
        the heads in evaluation mode, one per member, for F features; and the loss curves (epochs,
        members, 2): training loss and test loss (NaN without test examples).
    """
    features = torch.from_numpy(examples.inputs)
    views = {member.group: member for member in members}
    smallest = min(len(member.train) for member in members)
    components = min(settings.components, smallest - 1, features.shape[1])
    projections = {
        group: _principal(features[member.train], components, settings.whitening)
        for group, member in views.items()
    }
    projected = {g: (features - c) @ p for g, (c, p) in projections.items()}
    tasks = 0 if examples.task_vectors is None else examples.task_vectors.shape[1]
    outputs = examples.labels.shape[1]
    sizes = Architecture(components, tasks, settings.hidden, outputs, examples.task_layer)
    keys = [(*key, member.group, member.seed) for member in members]
    heads = BatchedMLP(sizes, keys, settings.dropout)
    place = {group: number for number, group in enumerate(projected)}
    data = TrainingTensors(
        torch.stack(list(projected.values())),
        torch.tensor([place[member.group] for member in members]),
        None if examples.task_vectors is None else torch.from_numpy(examples.task_vectors),
        torch.from_numpy(examples.labels),
        torch.from_numpy(examples.probabilities),
    )
    curves = _descend(heads, data, members, settings, keys)
    centres = torch.stack([projections[member.group][0] for member in members])
    bases = torch.stack([projections[member.group][1] for member in members])
    return heads.eval().absorb(centres[:, None], bases), curves


@torch.inference_mode()
def predict(heads: BatchedMLP, member: int, examples: Examples, rows: np.ndarray) -> np.ndarray:
    """Logits (len(rows), types) of one head."""
    one = BatchedMLP(heads.architecture, [()])
    one.load_state_dict({name: t[member : member + 1] for name, t in heads.state_dict().items()})
    inputs = torch.from_numpy(examples.inputs[rows])[None]
    tasks = examples.task_vectors
    task = None if tasks is None else torch.from_numpy(tasks[rows])[None]
    logits: np.ndarray = one.eval()(inputs, task)[0].numpy()
    return logits


@dataclass(frozen=True)
class TrainingTensors:
    """Tensors of the examples; ``inputs`` (groups, N, components), ``group`` (members,)."""

    inputs: Tensor
    group: Tensor
    tasks: Tensor | None
    labels: Tensor
    probabilities: Tensor

    def losses(self, heads: BatchedMLP, rows: Tensor, probability_weight: float) -> Tensor:
        """(members, batch) losses of the rows (members, batch)."""
        inputs = self.inputs[self.group[:, None], rows]
        logits = heads(inputs, None if self.tasks is None else self.tasks[rows])
        return loss(logits, self.labels[rows], self.probabilities[rows], probability_weight)


def _principal(features: Tensor, components: int, whitening: float) -> tuple[Tensor, Tensor]:
    """Centre (F,) and projection (F, components) onto the leading principal directions."""
    centre = features.mean(dim=0)
    centred = features - centre
    variances, directions = torch.linalg.eigh(centred.T @ centred / len(features))
    variances = variances[-components:].clamp_min(1e-9)
    directions = directions[:, -components:]
    scales = variances ** (-whitening / 2)
    overall = (variances * scales**2).mean().sqrt()
    # The sign of an eigenvector is arbitrary; fix it, so that it does not depend on the library.
    signs = directions.gather(0, directions.abs().argmax(dim=0, keepdim=True)).sign()
    return centre, directions * signs * scales / overall


def _descend(
    heads: BatchedMLP,
    data: TrainingTensors,
    members: Sequence[Member],
    settings: PredictorSettings,
    keys: Sequence[tuple[str | int, ...]],
) -> np.ndarray:
    """Train the heads in place; returns the loss curves (epochs, members, 2)."""
    orders = [rng("order", *key) for key in keys]
    smallest = min(len(member.train) for member in members)
    batch = min(settings.batch, smallest)
    steps = smallest // batch
    optimiser = torch.optim.AdamW(
        heads.parameters(), lr=settings.learning_rate, weight_decay=settings.weight_decay
    )
    pace = torch.optim.lr_scheduler.OneCycleLR(
        optimiser,
        settings.learning_rate,
        total_steps=steps * settings.epochs,
        pct_start=settings.warm_up,
    )
    curves = np.full((settings.epochs, len(members), 2), np.nan)
    for epoch in range(settings.epochs):
        shuffled = [
            order.permutation(member.train)[: steps * batch]
            for order, member in zip(orders, members, strict=True)
        ]
        rows = torch.from_numpy(np.stack(shuffled))
        total = torch.zeros(len(members))
        heads.train()
        for step in range(steps):
            losses = data.losses(
                heads, rows[:, step * batch : (step + 1) * batch], settings.probability_weight
            ).mean(dim=1)
            optimiser.zero_grad()
            losses.sum().backward()
            optimiser.step()
            pace.step()
            total += losses.detach()
        curves[epoch, :, 0] = (total / steps).numpy()
        curves[epoch, :, 1] = _test_losses(heads, data, members, settings)
        LOGGER.info(
            "epoch %d of %d: loss %.4f", epoch + 1, settings.epochs, curves[epoch, :, 0].mean()
        )
    return curves


@torch.inference_mode()
def _test_losses(
    heads: BatchedMLP, data: TrainingTensors, members: Sequence[Member], settings: PredictorSettings
) -> np.ndarray:
    """(members,) mean loss over as many test examples as in the smallest group."""
    count = min(len(member.test) for member in members)
    if count == 0:
        return np.full(len(members), np.nan)
    heads.eval()
    rows = torch.from_numpy(np.stack([member.test[:count] for member in members]))
    return data.losses(heads, rows, settings.probability_weight).mean(dim=1).numpy()
