"""Backbones: what they pool, that both load, thawing from the end."""

import pytest
import torch
import torchvision
from efficientnet_lite_pytorch import EfficientNet

from grasptypes.predictors.backbone import KINDS, load_backbone, thaw, untrained_backbone
from grasptypes.predictors.weights import WEIGHTS_VARIABLE, find_weights

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


def test_features_show_a_shift_of_the_colours_that_the_last_ones_hide(monkeypatch, tmp_path):
    """What a linear probe finds in images it has not seen: objects of any brightness."""
    monkeypatch.delenv(WEIGHTS_VARIABLE, raising=False)
    monkeypatch.setenv("TORCH_HOME", str(tmp_path))
    backbone = load_backbone(find_weights(timeout_s=0), 64)
    torch.manual_seed(0)
    pictures = torch.full((150, 64, 64, 3), 245)
    for picture in pictures:
        left, top, width, height = torch.randint(8, 28, (4,)).tolist()
        patch = picture[top : top + height, left : left + width]
        patch[:] = torch.randint(30, 200, (3,)) + torch.randint(-20, 20, patch.shape)
    with torch.inference_mode():
        lighter, darker = (backbone((pictures + s).to(torch.uint8)).double() for s in (10, -10))
    target = torch.cat([torch.ones(100), -torch.ones(100)]).double()

    def found(part):
        train = torch.cat([lighter[:100, part], darker[:100, part]])
        centre, spread = train.mean(dim=0), train.std(dim=0) + 1e-6
        train = (train - centre) / spread
        ridge = torch.eye(train.shape[1], dtype=torch.float64)
        weights = torch.linalg.solve(train.T @ train + ridge, train.T @ target)
        signs = zip((lighter, darker), (1, -1), strict=True)
        right = [s * (((f[100:, part] - centre) / spread) @ weights) for f, s in signs]
        return (torch.cat(right) > 0).double().mean().item()

    fine, coarse = slice(0, -1280), slice(-1280, None)
    assert found(fine) > 0.98
    assert found(fine) > found(coarse) + 0.05


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
