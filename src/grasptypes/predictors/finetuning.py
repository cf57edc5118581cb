"""Training of a head together with the last blocks of the backbone, or all of it."""

from __future__ import annotations

import copy
import logging
from collections.abc import Sequence

import numpy as np
import torch

from grasptypes.predictors.backbone import Backbone, thaw
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member
from grasptypes.predictors.predictor import Architecture, BatchedMLP, loss
from grasptypes.seeds import rng
from grasptypes.settings.predictors import PredictorSettings

LOGGER = logging.getLogger("grasptypes")


class Network(torch.nn.Module):
    """A backbone and one head: images and task to logits."""

    def __init__(self, backbone: Backbone, head: BatchedMLP) -> None:
        super().__init__()
        self.backbone = backbone
        self.head = head

    def forward(self, pictures: torch.Tensor, task: torch.Tensor | None = None) -> torch.Tensor:
        """Logits (B, types) of images (B, H, W, 3) uint8 and tasks (B, T) one-hot."""
        features = self.backbone(pictures)
        logits: torch.Tensor = self.head(features[None], None if task is None else task[None])[0]
        return logits


def fine_tune(
    backbone: Backbone,
    examples: Examples,
    member: Member,
    settings: PredictorSettings,
    key: tuple[str | int, ...],
) -> tuple[Network, np.ndarray]:
    """Train a copy of the backbone with a head on one split.

    Batch normalisation keeps its statistics: batches of one fold are too small to update them.

    Args:
        examples: with images (N, H, W, 3) uint8 as inputs.
        key: name of the computation, for its random numbers.

    Returns:
        the network in evaluation mode, and the training loss of each epoch (epochs,).
    """
    names = (*key, member.group, member.seed)
    tasks = 0 if examples.task_vectors is None else examples.task_vectors.shape[1]
    inputs, outputs = backbone.kind.features, examples.labels.shape[1]
    sizes = Architecture(inputs, tasks, settings.hidden, outputs, examples.task_layer)
    network = Network(copy.deepcopy(backbone), BatchedMLP(sizes, [names], settings.dropout)).eval()
    thawed = thaw(network.backbone, settings.finetune, settings.finetuning.last_blocks)
    optimiser = torch.optim.AdamW(
        [
            {"params": network.head.parameters(), "lr": settings.learning_rate},
            {"params": thawed, "lr": settings.finetuning.learning_rate},
        ],
        weight_decay=settings.weight_decay,
    )
    order = rng("order", *names)
    losses = np.zeros(settings.finetuning.epochs)
    for epoch in range(settings.finetuning.epochs):
        network.head.train()
        shuffled = order.permutation(member.train)
        batches = np.array_split(shuffled, max(1, len(shuffled) // settings.finetuning.batch))
        for rows in batches:
            logits = network(*_inputs(examples, rows))
            labels = torch.from_numpy(examples.labels[rows])
            shares = torch.from_numpy(examples.probabilities[rows])
            value = loss(logits, labels, shares, settings.probability_weight).mean()
            optimiser.zero_grad()
            value.backward()
            optimiser.step()
            losses[epoch] += value.item() / len(batches)
        LOGGER.info(
            "epoch %d of %d: loss %.4f", epoch + 1, settings.finetuning.epochs, losses[epoch]
        )
    return network.eval(), losses


@torch.inference_mode()
def predict_pictures(
    network: Network, examples: Examples, rows: Sequence[int] | np.ndarray, batch: int
) -> np.ndarray:
    """Logits (len(rows), types) of images."""
    rows = np.asarray(rows)
    chunks = [rows[start : start + batch] for start in range(0, len(rows), batch)]
    return torch.cat([network(*_inputs(examples, chunk)) for chunk in chunks]).numpy()


def _inputs(examples: Examples, rows: np.ndarray) -> tuple[torch.Tensor, torch.Tensor | None]:
    tasks = examples.task_vectors
    return (
        torch.from_numpy(examples.inputs[rows]),
        None if tasks is None else torch.from_numpy(tasks[rows]),
    )
