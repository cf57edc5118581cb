"""What a backbone's own classifier says: the log-probabilities of ImageNet's 1,000 classes."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import torch
from scipy.special import log_softmax

from grasptypes.errors import InputError
from grasptypes.predictors.weights import Weights

CLASSES = 1000


def class_scores(weights: Weights, features: np.ndarray) -> np.ndarray:
    """Log-probabilities (N, 1000) of the classes.

    The classifier is a linear function of the spatial mean of the last block's output, which is the
    end of the feature vector.

    Args:
        features: (N, F) of :class:`grasptypes.predictors.backbone.Backbone`.

    Raises:
        InputError: the weights have no classifier for these features.
    """
    state = torch.load(weights.path, map_location="cpu", weights_only=True)
    for name, tensor in state.items():
        if name.endswith(".weight") and tensor.ndim == 2 and len(tensor) == CLASSES:
            matrix = tensor.numpy()
            bias = state[name.removesuffix("weight") + "bias"].numpy()
            scores = features[:, -matrix.shape[1] :] @ matrix.T + bias
            return np.asarray(log_softmax(scores, axis=1), dtype=np.float32)
    raise InputError(weights.path, "", "has no classifier of ImageNet's classes")


def class_names() -> list[str]:
    """The names of the classes in the order of the scores."""
    from torchvision.models import MobileNet_V2_Weights

    return list(MobileNet_V2_Weights.IMAGENET1K_V1.meta["categories"])


def class_places(names: Iterable[str]) -> list[int]:
    """The places of classes by name; two classes are called crane, and two maillot."""
    wanted = set(names)
    return [place for place, name in enumerate(class_names()) if name in wanted]
