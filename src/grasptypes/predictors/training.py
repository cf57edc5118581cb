"""Training of heads on frozen features, for all folds and seeds of a table at once."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
import torch
from torch import Tensor

from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member
from grasptypes.predictors.predictor import Architecture, BatchedMLP, loss
from grasptypes.seeds import rng
from grasptypes.settings.predictors import PredictorSettings

LOGGER = logging.getLogger("grasptypes")
Heads = TypeVar("Heads", bound=BatchedMLP)


def fit(
    examples: Examples,
    members: Sequence[Member],
    settings: PredictorSettings,
    key: tuple[str | int, ...],
) -> tuple[BatchedMLP, np.ndarray]:
    """Train one head per member, and convert it to take the features themselves.

    Args:
        examples: with features as inputs.
        members: heads to train.
        settings: training settings.
        key: name of the computation, for its random numbers.

    Returns:
        the heads in evaluation mode, one per member, for F features; and the loss curves (epochs,
        members, 2): training loss and test loss (NaN without test examples).
    """
    heads, data, curves = fit_projected(examples, members, settings, key, BatchedMLP)
    return heads.absorb(data.centres[data.group][:, None], data.bases[data.group]), curves


def fit_projected(
    examples: Examples,
    members: Sequence[Member],
    settings: PredictorSettings,
    key: tuple[str | int, ...],
    make: Callable[[Architecture, Sequence[tuple[str | int, ...]], float], Heads],
) -> tuple[Heads, TrainingTensors, np.ndarray]:
    """Train one head per member in the leading principal directions of its training features.

    It is a change of coordinates that makes training several times faster. All heads use as many
    directions and as many steps per epoch as the smallest training split allows.

    Args:
        examples: with features as inputs.
        key: name of the computation, for its random numbers.
        make: makes the heads of their sizes, keys and dropout.

    Returns:
        the heads in evaluation mode, for the inputs of the tensors; these tensors; and the loss
        curves as in :func:`fit`.
    """
    features = torch.from_numpy(examples.inputs)
    views = {member.group: member for member in members}
    smallest = min(len(member.train) for member in members)
    components = min(settings.components, smallest - 1, features.shape[1])
    projections = {
        group: _principal(features[member.train], components, settings.whitening)
        for group, member in views.items()
    }
    tasks = 0 if examples.task_vectors is None else examples.task_vectors.shape[1]
    outputs = examples.labels.shape[1]
    sizes = Architecture(components, tasks, settings.hidden, outputs, examples.task_layer)
    keys = [(*key, member.group, member.seed) for member in members]
    heads = make(sizes, keys, settings.dropout)
    place = {group: number for number, group in enumerate(projections)}
    data = TrainingTensors(
        torch.stack([(features - c) @ p for c, p in projections.values()]),
        torch.tensor([place[member.group] for member in members]),
        torch.stack([centre for centre, _ in projections.values()]),
        torch.stack([basis for _, basis in projections.values()]),
        None if examples.task_vectors is None else torch.from_numpy(examples.task_vectors),
        torch.from_numpy(examples.labels),
        torch.from_numpy(examples.probabilities),
    )
    curves = _descend(heads, data, members, settings, keys)
    return heads.eval(), data, curves


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
    """Tensors of the examples.

    Attributes:
        inputs: (groups, N, components) coordinates of the features in each group's directions.
        group: (members,) the group of each member.
        centres: (groups, F) where the coordinates of the features are 0.
        bases: (groups, F, components) the directions.
        tasks: (N, T) task vectors, if any.
        labels: (N, types) of 0 and 1.
        probabilities: (N, types), sum 1.
    """

    inputs: Tensor
    group: Tensor
    centres: Tensor
    bases: Tensor
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
