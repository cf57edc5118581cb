"""Heads that a task modulates: its embedding scales and shifts the first layer's outputs.

FiLM: E. Perez et al., FiLM: Visual Reasoning with a General Conditioning Layer, AAAI 2018.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import torch
from torch import Tensor, nn

from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member
from grasptypes.predictors.predictor import LAYERS, Architecture, BatchedMLP
from grasptypes.predictors.training import TrainingTensors, _descend, _principal
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
    features = torch.from_numpy(examples.inputs)
    tasks = torch.from_numpy(examples.task_vectors)
    smallest = min(len(member.train) for member in members)
    components = min(settings.components, smallest - 1, features.shape[1])
    projected = {}
    for group, member in {member.group: member for member in members}.items():
        centre, basis = _principal(features[member.train], components, settings.whitening)
        projected[group] = (features - centre) @ basis
    place = {group: number for number, group in enumerate(projected)}
    data = TrainingTensors(
        torch.stack(list(projected.values())),
        torch.tensor([place[member.group] for member in members]),
        tasks,
        torch.from_numpy(examples.labels),
        torch.from_numpy(examples.probabilities),
    )
    types = examples.labels.shape[1]
    sizes = Architecture(components, tasks.shape[1], settings.hidden, types)
    keys = [(*key, member.group, member.seed) for member in members]
    heads = FilmHeads(sizes, keys, settings.dropout, embedding)
    _descend(heads, data, members, settings, keys)
    return [
        _answer(_one(heads, sizes, k, embedding), data, k, member.test)
        for k, member in enumerate(members)
    ]


def _one(heads: FilmHeads, sizes: Architecture, number: int, embedding: int) -> FilmHeads:
    """One of many heads."""
    one = FilmHeads(sizes, [()], 0.0, embedding)
    state = {name: tensor[number : number + 1] for name, tensor in heads.state_dict().items()}
    one.load_state_dict(state)
    return one.eval()


@torch.inference_mode()
def _answer(head: FilmHeads, data: TrainingTensors, member: int, rows: np.ndarray) -> np.ndarray:
    """Logits (len(rows), types) of the head of one member."""
    assert data.tasks is not None
    inputs = data.inputs[data.group[member]][rows]
    logits: np.ndarray = head(inputs[None], data.tasks[rows][None])[0].numpy()
    return logits
