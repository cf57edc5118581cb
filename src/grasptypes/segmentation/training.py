"""Training of the network that names roles."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from grasptypes.seeds import rng, seed
from grasptypes.segmentation.network import RoleNetwork
from grasptypes.segmentation.samples import RoleSamples, family_weights
from grasptypes.settings.roles import read_roles
from grasptypes.settings.segmentation import RoleTrainingSettings

LOGGER = logging.getLogger("grasptypes")


class _Layers(nn.Module):
    """The layers of a `RoleNetwork`, as torch trains them."""

    def __init__(self, inputs: int, outputs: int, width: int, dropout: float) -> None:
        super().__init__()
        sizes = ((inputs, width), (width, width), (3 * width, width), (width, outputs))
        self.layers = nn.ModuleList(nn.Linear(*size) for size in sizes)
        self.dropout = nn.Dropout(dropout)

    def forward(self, descriptors: Tensor) -> Tensor:
        """Logits (B, N, R) of descriptors (B, N, D)."""
        first, second, third, last = self.layers
        points = torch.relu(second(self.dropout(torch.relu(first(descriptors)))))
        pooled = torch.cat(
            [points.mean(dim=1, keepdim=True), points.amax(dim=1, keepdim=True)], dim=2
        )
        context = torch.cat([points, pooled.expand(-1, points.shape[1], -1)], dim=2)
        logits: Tensor = last(self.dropout(torch.relu(third(context))))
        return logits


def train_network(
    samples: RoleSamples,
    rows: NDArray[np.intp],
    settings: RoleTrainingSettings,
    key: Sequence[str | int],
) -> RoleNetwork:
    """A network trained on some of the shapes; large families count less than in proportion.

    Args:
        rows: (n,) shapes to learn from.
        key: name of the computation, for its random numbers.
    """
    inputs = samples.descriptors[rows]
    centre = inputs.mean(axis=(0, 1), dtype=np.float64).astype(np.float32)
    scale = (inputs.std(axis=(0, 1), dtype=np.float64) + 1e-6).astype(np.float32)
    limit = RoleNetwork.LIMIT
    scaled = torch.from_numpy(np.clip((inputs - centre) / scale, -limit, limit))
    known = samples.roles[rows, : inputs.shape[1]]
    weights = torch.from_numpy(family_weights(samples.families[rows]))
    targets = torch.from_numpy(known)
    roles = tuple(read_roles().roles)
    torch.manual_seed(seed("role network", *key))
    layers = _Layers(inputs.shape[2], len(roles), settings.width, settings.dropout)
    _descend(layers, (scaled, targets, weights), settings, rng("role batches", *key))
    tensors = [layer for layer in layers.layers if isinstance(layer, nn.Linear)]
    return RoleNetwork(
        roles,
        inputs.shape[1],
        centre,
        scale,
        tuple(layer.weight.detach().numpy().T.copy() for layer in tensors),
        tuple(layer.bias.detach().numpy().copy() for layer in tensors),
    )


def _role_weights(targets: Tensor, power: float) -> Tensor:
    """Weights (R,) of the roles, frequent ones lower; the mean over all points is 1."""
    count = torch.bincount(targets.flatten(), minlength=len(read_roles().roles)).double()
    weights = torch.where(count > 0, count.clamp_min(1) ** -power, 0.0)
    return (weights * count.sum() / (weights * count).sum()).float()


def _descend(
    layers: _Layers,
    data: tuple[Tensor, Tensor, Tensor],
    settings: RoleTrainingSettings,
    draw: np.random.Generator,
) -> None:
    """Train the layers in place on descriptors (n, N, D), roles (n, N) and weights (n,)."""
    inputs, targets, weights = data
    batch = min(settings.batch, len(inputs))
    steps = len(inputs) // batch
    optimiser = torch.optim.AdamW(
        layers.parameters(), settings.learning_rate, weight_decay=settings.weight_decay
    )
    pace = torch.optim.lr_scheduler.OneCycleLR(
        optimiser, settings.learning_rate, total_steps=steps * settings.epochs
    )
    balance = _role_weights(targets, settings.balance)
    layers.train()
    for epoch in range(settings.epochs):
        total, order = 0.0, torch.from_numpy(draw.permutation(len(inputs)))
        for step in range(steps):
            rows = order[step * batch : (step + 1) * batch]
            seen = inputs[rows]
            logits = layers(seen + settings.noise * torch.randn_like(seen))
            losses = nn.functional.cross_entropy(
                logits.flatten(0, 1),
                targets[rows].flatten(),
                weight=balance,
                reduction="none",
                label_smoothing=settings.label_smoothing,
            )
            loss = (losses.reshape(batch, -1).mean(dim=1) * weights[rows]).mean()
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            pace.step()
            total += float(loss.detach())
        LOGGER.info("epoch %d of %d: loss %.4f", epoch + 1, settings.epochs, total / steps)
    layers.eval()
