"""Images per second of the backbone and of a plain fp32 torchvision loop, one thread each."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import torch
import torchvision
from benchmarks.figures import Figure, rates, seconds

from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.features import extract
from grasptypes.predictors.weights import Weights, find_weights
from grasptypes.renders.archives import read_pictures
from grasptypes.settings.params import Params
from grasptypes.settings.predictors import NO_TASK


def measure(settings: Mapping[str, Any], params: Params) -> Iterator[Figure]:
    """Both go from images of the workflow's size to pooled features."""
    torch.set_num_threads(1)
    weights = find_weights(timeout_s=0)
    pictures = read_pictures(sorted(Path("data/renders").glob("*.zip"))[0])[: settings["pictures"]]
    how, input_px = params.features, params.backbone.input_px
    backbone = load_backbone(weights, input_px)
    ours = partial(extract, backbone, pictures, {NO_TASK: 0}, how.batch)
    plain = partial(_plain, _network(weights), pictures, input_px, how.batch)
    taken_s = seconds(ours, plain, rounds=settings["rounds"], clock=time.process_time)
    yield rates("features", "pictures/s", taken_s, len(pictures))


def _network(weights: Weights) -> torchvision.models.MobileNetV2:
    """torchvision's MobileNetV2; with random weights if another network is in use."""
    network = torchvision.models.mobilenet_v2()
    if weights.backbone == "mobilenet_v2":
        network.load_state_dict(torch.load(weights.path, weights_only=True))
    return network.eval()


@torch.inference_mode()
def _plain(
    network: torchvision.models.MobileNetV2, pictures: np.ndarray, input_px: int, batch: int
) -> None:
    functional = torchvision.transforms.functional
    for chunk in torch.split(torch.from_numpy(pictures).permute(0, 3, 1, 2), batch):
        x = functional.resize(chunk.to(torch.float32) / 255, [input_px, input_px])
        x = functional.normalize(x, [0.485, 0.456, 0.406], [0.229, 0.224, 0.225])
        network.features(x).mean(dim=(2, 3))
