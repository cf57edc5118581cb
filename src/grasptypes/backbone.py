"""The convolutional network whose features the predictors read."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping

import torch
from torch import Tensor, nn

from grasptypes.errors import InputError
from grasptypes.weights import Weights

FEATURES = 1280  # of both backbones
# ImageNet statistics of torchvision's weights; EfficientNet-Lite was trained on (x - 127) / 128.
_STATISTICS = {
    "mobilenet_v2": ((0.485, 0.456, 0.406), (0.229, 0.224, 0.225)),
    "efficientnet_lite0": ((127 / 255,) * 3, (128 / 255,) * 3),
}


class Backbone(nn.Module):
    """Pictures to features, with the preprocessing the weights were trained with.

    Args:
        stem: the network's convolutions, (B, 3, H, W) to (B, 1280, h, w).
        blocks: the stem's blocks, first to last; fine-tuning thaws from the end.
        statistics: mean and standard deviation of each RGB channel in [0, 1].
        input_px: height and width at which the network sees a picture.
    """

    mean: Tensor
    deviation: Tensor

    def __init__(
        self,
        stem: Callable[[Tensor], Tensor],
        blocks: list[nn.Module],
        statistics: tuple[tuple[float, ...], tuple[float, ...]],
        input_px: int,
    ) -> None:
        super().__init__()
        self.stem = stem
        self.blocks = nn.ModuleList(blocks)
        self.input_px = input_px
        mean, deviation = (torch.tensor(values).view(1, 3, 1, 1) * 255 for values in statistics)
        self.register_buffer("mean", mean, persistent=False)
        self.register_buffer("deviation", deviation, persistent=False)

    def forward(self, pictures: Tensor) -> Tensor:
        """Features (B, 1280) of pictures (B, H, W, 3) uint8."""
        x = pictures.permute(0, 3, 1, 2).to(torch.float32)
        size = (self.input_px, self.input_px)
        x = nn.functional.interpolate(x, size, mode="bilinear", antialias=True)
        x = ((x - self.mean) / self.deviation).contiguous(memory_format=torch.channels_last)
        # Averaged in single precision: bfloat16 would round away how a task shifts the colours.
        return self.stem(x).to(torch.float32).mean(dim=(2, 3))


def load_backbone(weights: Weights, input_px: int) -> Backbone:
    """The backbone with its weights, in evaluation mode; the weights are read as tensors only.

    Raises:
        InputError: the file is damaged, holds anything but tensors, or fits another network.
    """
    try:
        state = torch.load(weights.path, map_location="cpu", weights_only=True)
    except (OSError, RuntimeError, EOFError, ValueError, pickle.UnpicklingError) as error:
        reason = str(error).split("\n")[0].split(". ")[0]
        raise InputError(weights.path, "", f"not a file of tensors: {reason}") from error
    if not isinstance(state, Mapping) or not all(torch.is_tensor(v) for v in state.values()):
        raise InputError(weights.path, "", "not a state dict (a mapping of names to tensors)")
    backbone = untrained_backbone(weights.backbone, input_px, state, str(weights.path))
    return backbone.eval()


def untrained_backbone(
    name: str, input_px: int, state: Mapping[str, Tensor] | None = None, file: str = ""
) -> Backbone:
    """The network called ``name``, with ``state`` or else with its random start."""
    network, stem, blocks = _NETWORKS[name]()
    if state is not None:
        try:
            network.load_state_dict(state)
        except RuntimeError as error:
            detail = str(error).split("\n")[1] if "\n" in str(error) else str(error)
            raise InputError(file, "", f"not weights of {name}: {detail[:120]}") from error
    return Backbone(stem, blocks, _STATISTICS[name], input_px)


def thaw(backbone: Backbone, finetune: str, last_blocks: int) -> list[nn.Parameter]:
    """Choose what training may change.

    Args:
        finetune: ``none``, ``last_blocks`` or ``all``.
        last_blocks: how many blocks from the end ``last_blocks`` means.

    Returns:
        The parameters that may change; all others are frozen.
    """
    for parameter in backbone.parameters():
        parameter.requires_grad_(False)
    counts = {"none": 0, "last_blocks": last_blocks, "all": len(backbone.blocks)}
    count = counts[finetune]
    thawed = [p for block in list(backbone.blocks)[-count:] for p in block.parameters()]
    thawed = thawed if count else []
    for parameter in thawed:
        parameter.requires_grad_(True)
    return thawed


def _mobilenet_v2() -> tuple[nn.Module, Callable[[Tensor], Tensor], list[nn.Module]]:
    from torchvision.models import mobilenet_v2

    network = mobilenet_v2()
    return network, network.features, list(network.features)


def _efficientnet_lite0() -> tuple[nn.Module, Callable[[Tensor], Tensor], list[nn.Module]]:
    from efficientnet_lite_pytorch import EfficientNet

    network = EfficientNet.from_name("efficientnet-lite0")
    first = nn.ModuleList([network._conv_stem, network._bn0])
    last = nn.ModuleList([network._conv_head, network._bn1])
    return network, network.extract_features, [first, *network._blocks, last]


_NETWORKS = {"mobilenet_v2": _mobilenet_v2, "efficientnet_lite0": _efficientnet_lite0}
