"""The head of the paper's predictors: its sizes, and many of them computed together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import torch
from torch import Tensor, nn

from grasptypes.predictors.variants import TASK_LAYER
from grasptypes.seeds import seed

OUTPUT_START = 0.1  # scale of the last layer's initial weights, relative to He initialisation
LAYERS = 4  # fully connected layers of the head (paper, section III-D)


@dataclass(frozen=True)
class Architecture:
    """Sizes of a head.

    Attributes:
        inputs: number of features of an image.
        tasks: length of the task vector, 0 for a head without one.
        hidden: outputs of the first three layers.
        outputs: number of grasp types.
        task_layer: the layer at which the task enters, from 1.
    """

    inputs: int
    tasks: int
    hidden: tuple[int, int, int]
    outputs: int
    task_layer: int = TASK_LAYER

    def shapes(self) -> list[tuple[int, int]]:
        """Inputs and outputs of the four layers."""
        inputs = [self.inputs, *self.hidden]
        inputs[self.task_layer - 1] += self.tasks
        return list(zip(inputs, [*self.hidden, self.outputs], strict=True))


class BatchedMLP(nn.Module):
    """Any number of heads with the same architecture, computed in parallel.

    Training the folds and seeds of a table together costs a fraction of training them one by one.

    Args:
        architecture: the sizes.
        keys: one per head; it names the head's initial weights and dropout (see
            :mod:`grasptypes.seeds`), so that neither depends on the other heads.
        dropout: share of the first two layers' outputs dropped in training.
    """

    def __init__(
        self,
        architecture: Architecture,
        keys: Sequence[tuple[str | int, ...]],
        dropout: float = 0.0,
    ) -> None:
        super().__init__()
        self.architecture = architecture
        self.dropout = dropout
        self.weights = nn.ParameterList()
        self.biases = nn.ParameterList()
        self._dropouts = [torch.Generator().manual_seed(seed("dropout", *key)) for key in keys]
        generators = [torch.Generator().manual_seed(seed("head", *key)) for key in keys]
        for inputs, outputs in architecture.shapes():
            start = [torch.randn(inputs, outputs, generator=g) for g in generators]
            self.weights.append(nn.Parameter(torch.stack(start) * (2 / inputs) ** 0.5))
            self.biases.append(nn.Parameter(torch.zeros(len(keys), 1, outputs)))
        # Initial outputs are close to zero; large ones take most of the training to unlearn.
        with torch.no_grad():
            self.weights[-1] *= OUTPUT_START

    def forward(self, features: Tensor, task: Tensor | None = None) -> Tensor:
        """Logits (K, B, outputs) of K heads.

        Args:
            features: (K, B, inputs).
            task: (K, B, tasks) one-hot, if the architecture has a task vector.
        """
        x = features
        for layer, (weight, bias) in enumerate(zip(self.weights, self.biases, strict=True)):
            if layer == self.architecture.task_layer - 1 and task is not None:
                x = torch.cat([x, task], dim=-1)
            x = torch.baddbmm(bias, x, weight)
            if layer < LAYERS - 1:
                x = torch.relu(x)
            if layer < 2:
                x = self._drop_out(x)
        return x

    def _drop_out(self, x: Tensor) -> Tensor:
        """In training, set a share of (K, B, n) to zero and scale up the rest."""
        if not self.training or self.dropout == 0.0:
            return x
        draws = [torch.rand(x.shape[1:], generator=g) for g in self._dropouts]
        return x * (torch.stack(draws) >= self.dropout) / (1.0 - self.dropout)

    @torch.no_grad()
    def absorb(self, centre: Tensor, projection: Tensor) -> BatchedMLP:
        """Equivalent heads for inputs ``x``, where these take ``(x - centre) @ projection``.

        Args:
            centre: (K, 1, F), one per head.
            projection: (K, F, inputs), one per head.
        """
        narrow, inputs = self.architecture.inputs, projection.shape[1]
        wide = replace(self.architecture, inputs=inputs)
        heads = BatchedMLP(wide, [()] * len(projection), self.dropout)
        kept = {name: t for name, t in self.state_dict().items() if name != "weights.0"}
        heads.load_state_dict(kept, strict=False)
        # Weights of the task, where it enters at the first layer, stay as they are.
        seen = torch.bmm(projection, self.weights[0][:, :narrow])
        heads.weights[0].copy_(torch.cat([seen, self.weights[0][:, narrow:]], dim=1))
        heads.biases[0].copy_(self.biases[0] - torch.bmm(centre, seen))
        return heads.train(self.training)


def loss(
    logits: Tensor, labels: Tensor, probabilities: Tensor, probability_weight: float
) -> Tensor:
    """Cross-entropy of the sigmoid with the labels plus that of the softmax with the probabilities.

    With the first term alone, the softmax vector has an angular similarity of about 0.4, because
    nothing pushes the logits of absent types far below the others.

    Args:
        logits: (..., types).
        labels: (..., types) of 0 and 1.
        probabilities: (..., types), sum 1.
        probability_weight: weight of the second term.

    Returns:
        (...) one value per sample; the term of the labels is the mean over types.
    """
    binary = nn.functional.binary_cross_entropy_with_logits(logits, labels, reduction="none")
    vector = -(probabilities * torch.log_softmax(logits, dim=-1)).sum(dim=-1)
    return binary.mean(dim=-1) + probability_weight * vector
