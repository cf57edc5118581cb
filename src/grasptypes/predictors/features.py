"""Frozen features of all images of an object, one set per encoding of the task."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
import torch

from grasptypes.files import read_npz
from grasptypes.predictors.backbone import Backbone
from grasptypes.renders.archives import read_pictures
from grasptypes.settings.predictors import NO_TASK


def encodings(tasks: Mapping[str, int]) -> dict[str, int]:
    """Colour shift of each encoding: 0 for :data:`NO_TASK`, and that of each task.

    Args:
        tasks: colour shift of each task, in the order of the task vector.
    """
    return {NO_TASK: 0} | dict(tasks)


def shift_colours(pictures: np.ndarray, shift: int) -> np.ndarray:
    """Encode a task in images: add ``shift`` to each RGB value, clipped to [0, 255].

    Paper, section III-D. Args: images (..., 3) uint8. Returns: the same shape and type.
    """
    return np.clip(pictures.astype(np.int16) + shift, 0, 255).astype(np.uint8)


def read_inputs(
    paths: Iterable[str | Path], tasks: Mapping[str, int]
) -> dict[str, dict[str, np.ndarray]]:
    """Object to encoding to one input per view, from files named after their objects.

    Args:
        paths: features (.npz), or archives of images (.zip) that are encoded here.
        tasks: colour shift of each task, in the order of the task vector.

    Returns:
        arrays (V, F) float32 or (V, H, W, 3) uint8.
    """
    return {path.stem: _read_encodings(path, tasks) for path in map(Path, paths)}


def _read_encodings(path: Path, tasks: Mapping[str, int]) -> dict[str, np.ndarray]:
    if path.suffix == ".npz":
        return read_npz(path)
    pictures = read_pictures(path)
    return {name: shift_colours(pictures, shift) for name, shift in encodings(tasks).items()}


def extract(
    backbone: Backbone,
    pictures: np.ndarray,
    shifts: Mapping[str, int],
    batch: int,
) -> dict[str, np.ndarray]:
    """Features of the images in every encoding.

    Args:
        pictures: (N, H, W, 3) uint8.
        shifts: encoding to colour shift, see :func:`encodings`.
        batch: images per batch; affects speed and hardly the result.

    Returns:
        encoding to (N, F) float32.
    """
    backbone = for_inference(backbone)
    features = {}
    for encoding, shift in shifts.items():
        tensor = torch.from_numpy(shift_colours(pictures, shift))
        parts = [forward(backbone, chunk) for chunk in torch.split(tensor, batch)]
        features[encoding] = torch.cat(parts).numpy()
    return features


def for_inference(backbone: Backbone) -> Backbone:
    """The same backbone in evaluation mode, in the memory layout that is fastest on CPUs."""
    return backbone.to(memory_format=torch.channels_last).eval()


@torch.inference_mode()
def forward(backbone: Backbone, pictures: torch.Tensor) -> torch.Tensor:
    """Features (B, F) float32 of a batch (B, H, W, 3) uint8, without gradients."""
    features: torch.Tensor = backbone(pictures)
    return features
