"""A trained predictor on disk: tensors as safetensors, everything else as JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import safetensors
import safetensors.torch
import torch
from scipy.special import expit, softmax

from grasptypes.errors import InputError
from grasptypes.files import write_bytes
from grasptypes.predictors.backbone import Backbone, load_backbone
from grasptypes.predictors.features import for_inference, forward, shift_colours
from grasptypes.predictors.predictor import Architecture, BatchedMLP
from grasptypes.predictors.variants import VARIANTS
from grasptypes.predictors.weights import WEIGHTS_VARIABLE, Weights
from grasptypes.records import Record
from grasptypes.settings.base import Many

FROZEN = "none"


class TrainedRecord(Record):
    """What all trained predictors state.

    Attributes:
        model: name of its variant.
        labels: label source it was trained on.
        types: names of its outputs.
        backbone: name of its backbone.
        weights: name and checksum of the backbone's weights.
        input_px: size of the backbone's input image.
        finetune: ``none`` if the backbone is unchanged from its weights file.
    """

    model: str
    labels: str
    types: Many[str]
    backbone: str
    weights: str
    input_px: int
    finetune: str


class ModelCard(TrainedRecord):
    """Everything needed to use a predictor, apart from its tensors.

    Attributes:
        tasks: in the order of the task vector.
        colour_shifts: shift of the RGB values that encodes each task.
        architecture: sizes of its head.
    """

    tasks: Many[str]
    colour_shifts: dict[str, int]
    architecture: Architecture

    @property
    def learned(self) -> Many[str]:
        """The tasks that it has learned: all that it knows."""
        return self.tasks

    @property
    def sees_task(self) -> bool:
        """Whether the answer depends on the task."""
        variant = VARIANTS[self.model]
        return variant.picture_shows_task or variant.task_vector


class PredictorNetwork:
    """A backbone, a head and their card: images and task to logits of grasp types."""

    def __init__(self, backbone: Backbone, head: BatchedMLP, card: ModelCard) -> None:
        self.backbone = for_inference(backbone)
        self.head = head.eval()
        self.card = card

    def answers(
        self, pictures: np.ndarray, task: str, facts: Sequence[float] = ()
    ) -> tuple[np.ndarray, np.ndarray]:
        """Softmax and sigmoid (N, types) of images (N, H, W, 3) uint8; size and mass do not matter.

        Raises:
            InputError: the predictor does not know the task.
        """
        logits = self.logits(pictures, task)
        return softmax(logits, axis=-1), expit(logits)

    def logits(self, pictures: np.ndarray, task: str) -> np.ndarray:
        """Logits (N, types) of images (N, H, W, 3) uint8.

        Raises:
            InputError: the predictor does not know the task.
        """
        card = self.card
        if task not in card.tasks:
            raise InputError("task", task, f"unknown; allowed: {', '.join(card.tasks)}")
        variant = VARIANTS[card.model]
        if variant.picture_shows_task:
            pictures = shift_colours(pictures, card.colour_shifts[task])
        vector = None
        if variant.task_vector:
            vector = torch.zeros(len(pictures), len(card.tasks))
            vector[:, card.tasks.index(task)] = 1
        tensor = torch.from_numpy(np.ascontiguousarray(pictures))
        features = forward(self.backbone, tensor)
        with torch.inference_mode():
            vectors = None if vector is None else vector[None]
            logits: np.ndarray = self.head(features[None], vectors)[0].numpy()
        return logits


def write_predictor(
    heads: BatchedMLP,
    backbone: Backbone | None,
    card: ModelCard,
    tensors: str | Path,
    described: str | Path,
) -> None:
    """Write a predictor's tensors and card.

    Args:
        heads: its head.
        backbone: its backbone if fine-tuned, else None: the card then names it.
    """
    state = {f"head.{name}": tensor for name, tensor in heads.state_dict().items()}
    if backbone is not None:
        state |= {f"backbone.{name}": tensor for name, tensor in backbone.state_dict().items()}
    write_bytes(tensors, safetensors.torch.save({k: v.contiguous() for k, v in state.items()}))
    card.write(described)


def load_predictor(
    tensors: str | Path, described: str | Path, weights: Weights
) -> PredictorNetwork:
    """Load a predictor.

    Args:
        weights: weights of the backbone, which must be those the predictor was trained with.

    Raises:
        InputError: the file is damaged, or the weights are different.
    """
    card = ModelCard.read(described)
    same = card.weights.endswith(f"({weights.sha256[:8]})")  # regardless of the file name
    if card.backbone != weights.backbone or not same:
        raise InputError(
            described,
            "weights",
            f"trained on {card.backbone}, {card.weights}; "
            f"here is {weights.backbone}, {weights.name}; set {WEIGHTS_VARIABLE} to that file",
        )
    backbone = load_backbone(weights, card.input_px)
    if card.architecture.inputs != backbone.kind.features:
        raise InputError(
            described,
            "architecture.inputs",
            f"{card.architecture.inputs} features, but {card.backbone} gives "
            f"{backbone.kind.features} here",
        )
    heads = BatchedMLP(card.architecture, [()])
    try:
        state = safetensors.torch.load(Path(tensors).read_bytes())
        heads.load_state_dict(_below("head.", state))
        if card.finetune != FROZEN:
            backbone.load_state_dict(_below("backbone.", state))
    except (OSError, RuntimeError, safetensors.SafetensorError) as error:
        raise InputError(tensors, "", f"not this predictor's tensors: {error}") from error
    return PredictorNetwork(backbone, heads, card)


def _below(prefix: str, state: Mapping[str, torch.Tensor]) -> dict[str, torch.Tensor]:
    return {n.removeprefix(prefix): t for n, t in state.items() if n.startswith(prefix)}
