"""Heads that a task modulates: its embedding scales and shifts the first layer's outputs.

FiLM: E. Perez et al., FiLM: Visual Reasoning with a General Conditioning Layer, AAAI 2018.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import torch
from torch import Tensor, nn

from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member
from grasptypes.predictors.predictor import LAYERS, Architecture, BatchedMLP
from grasptypes.predictors.training import TrainingTensors, fit_projected
from grasptypes.seeds import seed
from grasptypes.settings.predictors import PredictorSettings


class FilmHeads(BatchedMLP):
    """Like :class:`BatchedMLP`, but the task multiplies what it would otherwise be appended to.

    It enters where the paper's vector does, between the first layer and the second. At the start,
    every task leaves the outputs as they are.

    Args:
        architecture: the sizes; the task vector may be one-hot or describe the task.
        keys: one per head.
        dropout: as in :class:`BatchedMLP`.
        embedding: numbers that stand for a task.
    """

    def __init__(
        self,
        architecture: Architecture,
        keys: Sequence[tuple[str | int, ...]],
        dropout: float,
        embedding: int,
    ) -> None:
        super().__init__(replace(architecture, tasks=0), keys, dropout)
        self.told, self.embedding = architecture, embedding
        tasks, width = architecture.tasks, architecture.hidden[0]
        generators = [torch.Generator().manual_seed(seed("embedding", *key)) for key in keys]
        start = [torch.randn(tasks, embedding, generator=g) for g in generators]
        self.embed = nn.Parameter(torch.stack(start) / tasks**0.5)
        self.modulate = nn.Parameter(torch.zeros(len(keys), embedding, 2 * width))

    def forward(self, features: Tensor, task: Tensor | None = None) -> Tensor:
        """Logits (K, B, outputs) of features (K, B, inputs) and task vectors (K, B, T)."""
        x = features
        for layer, (weight, bias) in enumerate(zip(self.weights, self.biases, strict=True)):
            x = torch.baddbmm(bias, x, weight)
            if layer < LAYERS - 1:
                x = torch.relu(x)
            if layer < 2:
                x = self._drop_out(x)
            if layer == 0 and task is not None:
                scale, shift = (task @ self.embed @ self.modulate).chunk(2, dim=-1)
                x = x * (1 + scale) + shift
        return x

    def one(self, number: int) -> FilmHeads:
        """One of the heads, in evaluation mode."""
        head = FilmHeads(self.told, [()], 0.0, self.embedding)
        state = {name: tensor[number : number + 1] for name, tensor in self.state_dict().items()}
        head.load_state_dict(state)
        return head.eval()


def try_film(
    examples: Examples,
    members: Sequence[Member],
    settings: PredictorSettings,
    key: tuple[str | int, ...],
    embedding: int,
) -> list[np.ndarray]:
    """Train a head per member like :func:`grasptypes.predictors.training.fit`, and test it.

    Args:
        examples: with features as inputs, and task vectors.

    Returns:
        for each member, the logits (m, types) of its test examples.
    """
    if examples.task_vectors is None:
        raise ValueError("FiLM needs task vectors")
    make = partial(FilmHeads, embedding=embedding)
    heads, data, _ = fit_projected(examples, members, settings, key, make)
    return [_answer(heads.one(k), data, k, member.test) for k, member in enumerate(members)]


@torch.inference_mode()
def _answer(head: FilmHeads, data: TrainingTensors, member: int, rows: np.ndarray) -> np.ndarray:
    """Logits (len(rows), types) of the head of one member."""
    assert data.tasks is not None
    inputs = data.inputs[data.group[member]][rows]
    logits: np.ndarray = head(inputs[None], data.tasks[rows][None])[0].numpy()
    return logits
