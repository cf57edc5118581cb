"""The predictor for unseen objects: a regularised linear head on features, size, mass and task.

Two outputs per grasp type: whether it occurs at all (a logistic function), and its share of the
grasps (a softmax). Without evidence both are the mean of all objects, since only the constant is
not penalised.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from scipy.special import expit, softmax
from torch import Tensor

from grasptypes.predictors.general_inputs import FACTS, Inputs, Projection, Targets
from grasptypes.predictors.memory import Memory
from grasptypes.settings.general import HeadSettings

# What a user may not know: nothing, the mass, all but the longest extent, everything.
UNKNOWN = ((), FACTS[3:], FACTS[1:], FACTS)


@dataclass(frozen=True)
class GeneralHead:
    """A trained head.

    Attributes:
        features, classes: projections of the images' numbers.
        facts: (2, 4) mean and standard deviation of size and mass.
        weights: (D, 2 x types), rows of the design; the constant is last.
        memory: of the objects learned from, if the head has one.
    """

    settings: HeadSettings
    features: Projection
    classes: Projection
    facts: np.ndarray
    weights: np.ndarray
    memory: Memory | None = None

    def answers(self, inputs: Inputs) -> tuple[np.ndarray, np.ndarray]:
        """How likely each type occurs (N, types), and its share of the grasps (N, types)."""
        told = probabilities(self.logits(inputs))
        return self.memory.mixed(*told, inputs) if self.memory else told

    def logits(self, inputs: Inputs) -> tuple[np.ndarray, np.ndarray]:
        """Logits (N, types) of the logistic output, and of the softmax, without the memory."""
        columns = design(inputs, self.settings, (self.features, self.classes), self.facts)
        occurs, shares = np.split(columns @ self.weights, 2, axis=1)
        return occurs, shares


def design(
    inputs: Inputs,
    settings: HeadSettings,
    projections: tuple[Projection, Projection],
    facts: np.ndarray,
) -> np.ndarray:
    """The head's linear inputs (N, D): all about the object, times the task and 1; 1 comes last."""
    columns = [
        settings.picture_scale * projections[0](inputs.features),
        settings.class_scale * projections[1](inputs.classes),
    ]
    if settings.facts:
        columns.append(settings.fact_scale * _fact_columns((inputs.facts - facts[0]) / facts[1]))
    about = np.hstack([*columns, np.ones((len(inputs), 1))])
    factors = np.hstack([settings.task_scale * inputs.tasks, np.ones((len(inputs), 1))])
    # The last column is 1 x 1, the constant.
    return np.asarray((factors[:, :, None] * about[:, None, :]).reshape(len(inputs), -1))


def _fact_columns(scaled: np.ndarray) -> np.ndarray:
    """Size and mass, their squares and products, and whether each is known: zeros if it is not."""
    known = np.isfinite(scaled).astype(float)
    values = np.nan_to_num(scaled)
    products = [values[:, i] * values[:, j] for i in range(4) for j in range(i, 4)]
    # Products have a mean where both are known, which must not be mistaken for evidence.
    return np.column_stack([values, *products, known[:, [0, 1, 3]] - 0.5])


def fit_head(inputs: Inputs, targets: Targets, settings: HeadSettings) -> GeneralHead:
    """Train a head; what is unknown at times is dropped from copies of the rows."""
    projections = (
        Projection.of(inputs.features, settings.pictures, settings.whitening),
        Projection.of(inputs.classes, settings.classes, settings.whitening),
    )
    scale = np.stack([np.nanmean(inputs.facts, axis=0), np.nanstd(inputs.facts, axis=0)])
    copies = [inputs.without(names) for names in UNKNOWN] if settings.facts else [inputs]
    columns = np.vstack([design(copy, settings, projections, scale) for copy in copies])
    repeated = Targets(*(np.concatenate([array] * len(copies)) for array in vars(targets).values()))
    weights = _descend(columns, repeated, settings.weight_decay)
    remembered = settings.memory.last_features > 0
    memory = Memory.of(inputs, targets, settings.memory) if remembered else None
    return GeneralHead(settings, *projections, scale, weights, memory)


def _descend(columns: np.ndarray, targets: Targets, weight_decay: float) -> np.ndarray:
    """The weights (D, 2 x types) with the least loss; the problem is convex, so there is one."""
    x = torch.from_numpy(columns.astype(np.float32))
    occurs, shares = (
        torch.from_numpy(array.astype(np.float32)) for array in (targets.occurs, targets.shares)
    )
    share = torch.from_numpy((targets.weights / targets.weights.sum()).astype(np.float32))
    types = occurs.shape[1]
    weights = torch.zeros(x.shape[1], 2 * types, requires_grad=True)
    search = torch.optim.LBFGS(
        [weights], max_iter=200, history_size=20, tolerance_grad=1e-6, line_search_fn="strong_wolfe"
    )

    def loss() -> Tensor:
        """The loss at the present weights, with its gradient."""
        search.zero_grad()
        first, second = torch.split(x @ weights, types, dim=1)
        binary = torch.nn.functional.binary_cross_entropy_with_logits(
            first, occurs, reduction="none"
        )
        cross = -(shares * torch.log_softmax(second, dim=1)).sum(dim=1)
        fitted = (share * (binary.sum(dim=1) + cross)).sum()
        total = fitted + weight_decay * (weights[:-1] ** 2).sum()
        total.backward()
        return total

    search.step(loss)
    return weights.detach().numpy()


def probabilities(logits: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """How likely each type occurs (N, types), and its share of the grasps (N, types)."""
    return expit(logits[0]), softmax(logits[1], axis=1)
