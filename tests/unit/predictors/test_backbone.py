"""Backbones: what they pool, that both load, thawing from the end."""

import pytest
import torch
import torchvision
from efficientnet_lite_pytorch import EfficientNet

from grasptypes.predictors.backbone import KINDS, thaw, untrained_backbone

NAMES = ("mobilenet_v2", "efficientnet_lite0")


@pytest.mark.parametrize("name", NAMES)
def test_features_have_the_documented_shape(name):
    pictures = torch.randint(0, 256, (2, 48, 48, 3), dtype=torch.uint8)
    with torch.inference_mode():
        features = untrained_backbone(name, 64).eval()(pictures)
    assert features.shape == (2, KINDS[name].features)
    assert features.dtype == torch.float32


@pytest.mark.parametrize("name", NAMES)
def test_features_are_pooled_from_the_last_block_of_each_resolution(name):
    backbone = untrained_backbone(name, 224).eval()
    sizes = []
    for block in backbone.blocks:
        block.register_forward_hook(lambda module, inputs, output: sizes.append(output.shape[2]))
    with torch.inference_mode():
        backbone(torch.zeros((1, 224, 224, 3), dtype=torch.uint8))
    following = [*sizes[1:], 0]
    last = [k for k, (size, after) in enumerate(zip(sizes, following, strict=True)) if after < size]
    assert last == list(KINDS[name].pooled)


@pytest.mark.parametrize("name", NAMES)
def test_the_last_features_are_the_networks_own(name):
    if name == "mobilenet_v2":
        network = torchvision.models.mobilenet_v2()
        body = network.features
    else:
        network = EfficientNet.from_name("efficientnet-lite0")
        body = network.extract_features
    own = untrained_backbone(name, 224, network.state_dict()).eval()
    network.eval()
    pictures = torch.randint(0, 256, (2, 224, 224, 3), dtype=torch.uint8)
    with torch.inference_mode():
        x = (pictures.permute(0, 3, 1, 2).float() - own.mean) / own.deviation
        expected = body(x).mean(dim=(2, 3))
        torch.testing.assert_close(own(pictures)[:, -1280:], expected)


@pytest.mark.parametrize("name", NAMES)
def test_thawing(name):
    backbone = untrained_backbone(name, 64)
    count = sum(p.numel() for p in backbone.blocks.parameters())
    assert thaw(backbone, "none", 2) == []
    some = sum(p.numel() for p in thaw(backbone, "last_blocks", 2))
    last = sum(p.numel() for p in backbone.blocks[-2:].parameters())
    assert some == last < count
    assert not any(p.requires_grad for p in backbone.blocks[:-2].parameters())
    assert sum(p.numel() for p in thaw(backbone, "all", 2)) == count
