"""Training of a head together with the last blocks of the backbone, or all of it."""

from __future__ import annotations

import copy
import logging
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import torch

from grasptypes.predictors.backbone import Backbone, thaw
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member
from grasptypes.predictors.predictor import BatchedMLP, loss
from grasptypes.predictors.training import fit
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

    The head is first trained on the features of the backbone as it is, like that of a frozen one; a
    head that starts at random would spoil the features before it has learnt to read them (A. Kumar
    et al., Fine-Tuning can Distort Pretrained Features and Underperform Out-of-Distribution, ICLR
    2022). Batch normalisation keeps its statistics: batches of one fold are too small to update
    them.

    Args:
        examples: with images (N, H, W, 3) uint8 as inputs.
        key: name of the computation, for its random numbers.

    Returns:
        the network in evaluation mode, and the training loss of each epoch (epochs,).
    """
    names = (*key, member.group, member.seed)
    tuning = settings.finetuning
    tuned = copy.deepcopy(backbone).eval()
    frozen = replace(examples, inputs=_features(tuned, examples.inputs, tuning.batch))
    trained, _ = fit(frozen, [member], settings, key)
    head = BatchedMLP(trained.architecture, [names], settings.dropout)
    head.load_state_dict(trained.state_dict())
    network = Network(tuned, head).eval()
    thawed = thaw(tuned, settings.finetune, tuning.last_blocks)
    optimiser = torch.optim.AdamW(
        [*head.parameters(), *thawed], tuning.learning_rate, weight_decay=settings.weight_decay
    )
    count = max(1, len(member.train) // tuning.batch)
    pace = torch.optim.lr_scheduler.OneCycleLR(
        optimiser,
        tuning.learning_rate,
        total_steps=count * tuning.epochs,
        pct_start=settings.warm_up,
    )
    order = rng("fine-tuning order", *names)
    losses = np.zeros(tuning.epochs)
    for epoch in range(tuning.epochs):
        network.head.train()
        batches = np.array_split(order.permutation(member.train), count)
        for rows in batches:
            logits = network(*_inputs(examples, rows))
            labels = torch.from_numpy(examples.labels[rows])
            shares = torch.from_numpy(examples.probabilities[rows])
            value = loss(logits, labels, shares, settings.probability_weight).mean()
            optimiser.zero_grad()
            value.backward()
            optimiser.step()
            pace.step()
            losses[epoch] += value.item() / count
        LOGGER.info("epoch %d of %d: loss %.4f", epoch + 1, tuning.epochs, losses[epoch])
    return network.eval(), losses


@torch.inference_mode()
def predict_pictures(
    network: Network, examples: Examples, rows: Sequence[int] | np.ndarray, batch: int
) -> np.ndarray:
    """Logits (len(rows), types) of images."""
    rows = np.asarray(rows)
    chunks = [rows[start : start + batch] for start in range(0, len(rows), batch)]
    return torch.cat([network(*_inputs(examples, chunk)) for chunk in chunks]).numpy()


@torch.inference_mode()
def _features(backbone: Backbone, pictures: np.ndarray, batch: int) -> np.ndarray:
    """Features (N, F) of images."""
    return torch.cat([backbone(chunk) for chunk in torch.from_numpy(pictures).split(batch)]).numpy()


def _inputs(examples: Examples, rows: np.ndarray) -> tuple[torch.Tensor, torch.Tensor | None]:
    tasks = examples.task_vectors
    return (
        torch.from_numpy(examples.inputs[rows]),
        None if tasks is None else torch.from_numpy(tasks[rows]),
    )
