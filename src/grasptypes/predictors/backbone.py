"""The convolutional network whose features the predictors read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import torch
from torch import Tensor, nn

from grasptypes.errors import InputError, parsing
from grasptypes.predictors.weights import Weights


@dataclass(frozen=True)
class BackboneSpec:
    """Specification of a network before it is built.

    Attributes:
        mean: mean of each RGB channel in [0, 1], as used to train the weights.
        deviation: standard deviation of each RGB channel, likewise.
        pooled: channels of the blocks whose outputs are features, by block number: the last block
            at each of the network's five resolutions, from 1/2 to 1/32.
    """

    mean: tuple[float, float, float]
    deviation: tuple[float, float, float]
    pooled: Mapping[int, int]

    @property
    def features(self) -> int:
        """Length of the feature vector."""
        return sum(self.pooled.values())


# ImageNet statistics of torchvision's weights; EfficientNet-Lite was trained on (x - 127) / 128.
KINDS = {
    "mobilenet_v2": BackboneSpec(
        (0.485, 0.456, 0.406), (0.229, 0.224, 0.225), {1: 16, 3: 24, 6: 32, 13: 96, 18: 1280}
    ),
    "efficientnet_lite0": BackboneSpec(
        (127 / 255,) * 3, (128 / 255,) * 3, {1: 16, 3: 24, 5: 40, 11: 112, 17: 1280}
    ),
}


class Backbone(nn.Module):
    """Images to features, with the preprocessing that the weights were trained with.

    The features are the spatial means of the last block's output and of the last one at every finer
    resolution. The last block was trained to recognise objects under any lighting: a shift of all
    colours by 10 levels, which encodes the task, hardly reaches it (a linear probe distinguishes
    the two shifts in 69 % of the images), but it is visible at finer resolutions (100 %).

    Args:
        blocks: blocks of the network, first to last; fine-tuning starts from the end.
        kind: the network they belong to.
        input_px: height and width of the network's input.
    """

    mean: Tensor
    deviation: Tensor

    def __init__(self, blocks: list[nn.Module], kind: BackboneSpec, input_px: int) -> None:
        super().__init__()
        self.blocks = nn.ModuleList(blocks)
        self.kind = kind
        self.input_px = input_px
        statistics = (kind.mean, kind.deviation)
        mean, deviation = (torch.tensor(values).view(1, 3, 1, 1) * 255 for values in statistics)
        self.register_buffer("mean", mean, persistent=False)
        self.register_buffer("deviation", deviation, persistent=False)

    def forward(self, pictures: Tensor) -> Tensor:
        """Features (B, F) of images (B, H, W, 3) uint8, coarsest resolution last."""
        x = pictures.permute(0, 3, 1, 2).to(torch.float32)
        size = (self.input_px, self.input_px)
        x = nn.functional.interpolate(x, size, mode="bilinear", antialias=True)
        x = ((x - self.mean) / self.deviation).contiguous(memory_format=torch.channels_last)
        pooled = []
        for number, block in enumerate(self.blocks):
            x = block(x)
            if number in self.kind.pooled:
                pooled.append(x.mean(dim=(2, 3)))
        return torch.cat(pooled, dim=1)


def load_backbone(weights: Weights, input_px: int) -> Backbone:
    """The backbone with its weights, in evaluation mode; only tensors are read from the file.

    Raises:
        InputError: the file is damaged, has content other than finite tensors, or does not fit the
            network.
    """
    with parsing(weights.path, "not a file of tensors"):
        state = torch.load(weights.path, map_location="cpu", weights_only=True)
    if not isinstance(state, Mapping) or not all(_is_weight(*item) for item in state.items()):
        raise InputError(weights.path, "", "not a state dict (a mapping of names to tensors)")
    endless = [name for name, tensor in state.items() if not torch.isfinite(tensor).all()]
    if endless:
        raise InputError(weights.path, str(endless[0]), "holds numbers that are not finite")
    backbone = untrained_backbone(weights.backbone, input_px, state, str(weights.path))
    return backbone.eval()


def _is_weight(name: object, value: object) -> bool:
    """Whether a member of a state dict is a dense tensor with a name."""
    dense = isinstance(value, Tensor) and value.layout is torch.strided and not value.is_quantized
    return dense and isinstance(name, str)


def untrained_backbone(
    name: str, input_px: int, state: Mapping[str, Tensor] | None = None, file: str = ""
) -> Backbone:
    """The network called ``name``, with the weights ``state`` or random ones."""
    network, blocks = _NETWORKS[name]()
    if state is not None:
        try:
            network.load_state_dict(state)
        except RuntimeError as error:
            detail = str(error).split("\n")[1] if "\n" in str(error) else str(error)
            raise InputError(file, "", f"not weights of {name}: {detail[:120]}") from error
    return Backbone(blocks, KINDS[name], input_px)


def thaw(backbone: Backbone, finetune: str, last_blocks: int) -> list[nn.Parameter]:
    """Select the parameters to train.

    Args:
        finetune: ``none``, ``last_blocks`` or ``all``.
        last_blocks: number of blocks from the end for ``last_blocks``.

    Returns:
        The parameters to train; all others are frozen.
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


def _mobilenet_v2() -> tuple[nn.Module, list[nn.Module]]:
    from torchvision.models import mobilenet_v2

    network = mobilenet_v2()
    return network, list(network.features)


def _efficientnet_lite0() -> tuple[nn.Module, list[nn.Module]]:
    from efficientnet_lite_pytorch import EfficientNet

    network = EfficientNet.from_name("efficientnet-lite0")
    # The blocks one by one, as in its own extract_features in evaluation mode.
    first = nn.Sequential(network._conv_stem, network._bn0, network._swish)
    last = nn.Sequential(network._conv_head, network._bn1, network._swish)
    return network, [first, *network._blocks, last]


_NETWORKS = {"mobilenet_v2": _mobilenet_v2, "efficientnet_lite0": _efficientnet_lite0}
