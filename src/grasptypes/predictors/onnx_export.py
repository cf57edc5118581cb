"""The predictor for unseen objects as one ONNX file: images, size, mass and task in, types out.

The head is written in torch for this; `test_onnx_export.py` compares it with the original.
"""

from __future__ import annotations

import math
import warnings
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import torch
from torch import Tensor, nn

from grasptypes.errors import InputError
from grasptypes.files import write_bytes
from grasptypes.predictors.general_inputs import FACTS, spread_of
from grasptypes.predictors.general_predictor import GeneralNetwork
from grasptypes.predictors.memory import SAME_TASK, Memory

# ONNX operators since 2021, which all runtimes have.
OPSET = 17
INPUTS, OUTPUTS = ("image", "facts", "task"), ("probability", "share")


class GeneralModule(nn.Module):
    """Backbone and head together.

    Raises:
        InputError: the head reads ImageNet's classes, which are not exported.
    """

    middle: Tensor
    directions: Tensor
    facts: Tensor
    weights: Tensor

    def __init__(self, network: GeneralNetwork) -> None:
        super().__init__()
        head = network.head
        if head.classes.directions.shape[1]:
            raise InputError("general.head.classes", "", "must be 0: classes are not exported")
        self.backbone = network.backbone
        self.settings = head.settings
        self.memory = MemoryModule(head.memory) if head.memory else None
        arrays = {
            "middle": head.features.middle,
            "directions": head.features.directions,
            "facts": head.facts,
            "weights": head.weights,
        }
        for name, array in arrays.items():
            self.register_buffer(name, torch.from_numpy(np.asarray(array, dtype=np.float32)))

    def forward(self, image: Tensor, facts: Tensor, task: Tensor) -> tuple[Tensor, Tensor]:
        """Probability and share (N, types) of each type.

        Args:
            image: (N, S, S, 3) uint8, of the backbone's size.
            facts: (N, 4) of `general_inputs.FACTS`; NaN where unknown.
            task: (N, K) coordinates of a task.
        """
        settings = self.settings
        features = self._features(image)
        columns = [settings.picture_scale * ((features - self.middle) @ self.directions)]
        if settings.facts:
            columns.append(
                settings.fact_scale * _fact_columns((facts - self.facts[0]) / self.facts[1])
            )
        ones = torch.ones_like(facts[:, :1])
        about = torch.cat([*columns, ones], dim=1)
        factors = torch.cat([settings.task_scale * task, ones], dim=1)
        design = (factors[:, :, None] * about[:, None, :]).flatten(1)
        occurs, shares = (design @ self.weights).chunk(2, dim=1)
        told = torch.sigmoid(occurs), torch.softmax(shares, dim=1)
        return self.memory(told, features, facts, task) if self.memory else told

    def _features(self, image: Tensor) -> Tensor:
        """As the backbone's, without scaling the image, for which ONNX has no exact operator."""
        x = (
            image.permute(0, 3, 1, 2).to(torch.float32) - self.backbone.mean
        ) / self.backbone.deviation
        pooled = []
        for number, block in enumerate(self.backbone.blocks):
            x = block(x)
            if number in self.backbone.kind.pooled:
                pooled.append(x.mean(dim=(2, 3)))
        return torch.cat(pooled, dim=1)


class MemoryModule(nn.Module):
    """As :class:`grasptypes.predictors.memory.Memory`."""

    looks: Tensor
    facts: Tensor
    tasks: Tensor
    occurs: Tensor
    shares: Tensor
    unknown: Tensor
    own: Tensor

    def __init__(self, memory: Memory) -> None:
        super().__init__()
        self.settings = memory.settings
        unknown = np.isnan(memory.occurs[:, :, 0])
        arrays = {
            "looks": memory.looks,
            "facts": memory.facts,
            "tasks": memory.tasks,
            "occurs": np.nan_to_num(memory.occurs),
            "shares": np.nan_to_num(memory.shares),
            "own": spread_of(self.settings.size_spread, self.settings.mass_spread),
            # Of what is impossible.
            "unknown": np.where(unknown, -np.inf, 0.0),
        }
        for name, array in arrays.items():
            self.register_buffer(name, torch.from_numpy(np.asarray(array, dtype=np.float32)))

    def forward(
        self, told: tuple[Tensor, Tensor], features: Tensor, facts: Tensor, task: Tensor
    ) -> tuple[Tensor, Tensor]:
        """Probability and share (N, types), mixed with those from memory."""
        seen = nn.functional.normalize(features[:, -self.looks.shape[1] :], dim=1)
        alike = torch.log_softmax(seen @ self.looks.T / self.settings.temperature, dim=1)
        known = alike + _log_density(facts[:, None] - self.facts, self.own)
        spread = self.facts.std(dim=0, correction=0)
        other = _log_density(facts - self.facts.mean(dim=0), spread)
        known = known + math.log(self.settings.known)
        other = other[:, None] + math.log(1 - self.settings.known)
        mixed = list(told)
        for number in range(len(self.tasks)):
            learned = ((task - self.tasks[number]).abs() < SAME_TASK).all(dim=1, keepdim=True)
            chances = torch.softmax(torch.cat([known + self.unknown[number], other], dim=1), dim=1)
            for place, memory in enumerate((self.occurs, self.shares)):
                mix = chances[:, :-1] @ memory[number] + chances[:, -1:] * told[place]
                mixed[place] = torch.where(learned, mix, mixed[place])
        return mixed[0], mixed[1]


def _log_density(off: Tensor, spread: Tensor) -> Tensor:
    """As `memory._log_density`."""
    terms = (off / spread) ** 2 / 2 + torch.log(spread)
    return -torch.where(torch.isnan(off), torch.zeros_like(terms), terms).sum(dim=-1)


def _fact_columns(scaled: Tensor) -> Tensor:
    """As `general._fact_columns`."""
    known = torch.logical_not(torch.isnan(scaled)).to(torch.float32)
    values = torch.where(known > 0, scaled, torch.zeros_like(scaled))
    count = len(FACTS)
    products = [values[:, i] * values[:, j] for i in range(count) for j in range(i, count)]
    told = known[:, [0, 1, 3]] - 0.5
    return torch.cat([values, torch.stack(products, dim=1), told], dim=1)


def export(network: GeneralNetwork, path: str | Path) -> None:
    """Write the network as ONNX, for any number of images.

    Raises:
        InputError: the package `onnx` is missing, or the head cannot be exported.
    """
    if find_spec("onnx") is None:
        raise InputError(path, "", "needs the package onnx: pip install 'grasptypes[onnx]'")
    size = network.card.input_px
    coordinates = network.code.directions.shape[1]
    example = (
        torch.zeros(2, size, size, 3, dtype=torch.uint8),
        torch.full((2, len(FACTS)), torch.nan),
        torch.zeros(2, coordinates),
    )
    with warnings.catch_warnings(), TemporaryDirectory() as folder:
        file = Path(folder) / "general.onnx"
        warnings.simplefilter("ignore")  # about what is not folded, and about the exporter's age
        torch.onnx.export(
            GeneralModule(network).eval(),
            example,
            str(file),
            input_names=list(INPUTS),
            output_names=list(OUTPUTS),
            dynamic_axes={name: {0: "count"} for name in (*INPUTS, *OUTPUTS)},
            opset_version=OPSET,
            dynamo=False,
        )
        write_bytes(path, file.read_bytes())
