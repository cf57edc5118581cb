"""Backbones: both load, damaged files are refused in one line, thawing starts from the end."""

import os
import pickle

import pytest
import torch

from grasptypes.backbone import FEATURES, load_backbone, thaw, untrained_backbone
from grasptypes.errors import InputError
from grasptypes.weights import WEIGHTS_VARIABLE, find_weights, weights_file

NAMES = ("mobilenet_v2", "efficientnet_lite0")


class Exploit:
    def __reduce__(self):
        return os.system, ("touch exploited",)


@pytest.mark.parametrize("name", NAMES)
def test_features_have_the_documented_shape(name):
    pictures = torch.randint(0, 256, (2, 48, 48, 3), dtype=torch.uint8)
    with torch.inference_mode():
        features = untrained_backbone(name, 64).eval()(pictures)
    assert features.shape == (2, FEATURES)
    assert features.dtype == torch.float32


def test_the_wheels_weights_load_and_tell_pictures_apart(monkeypatch, tmp_path):
    monkeypatch.delenv(WEIGHTS_VARIABLE, raising=False)
    monkeypatch.setenv("TORCH_HOME", str(tmp_path))
    backbone = load_backbone(find_weights(timeout_s=0), 64)
    flat = torch.full((1, 64, 64, 3), 200, dtype=torch.uint8)
    striped = flat.clone()
    striped[:, ::8] = 20
    with torch.inference_mode():
        a, b = backbone(flat), backbone(striped)
    assert not torch.allclose(a, b, atol=0.01)
    assert not backbone.training


@pytest.mark.skipif(WEIGHTS_VARIABLE not in os.environ, reason=f"{WEIGHTS_VARIABLE} is not set")
def test_the_named_weights_fit_torchvisions_network():
    weights = find_weights(timeout_s=0)
    assert weights.backbone == "mobilenet_v2"
    load_backbone(weights, 224)


def saved(path, content):
    torch.save(content, path)
    return weights_file("mobilenet_v2", "test", path)


def test_damaged_weights_are_refused_in_one_line(tmp_path):
    path = tmp_path / "weights.pth"
    whole = saved(path, {"a": torch.zeros(1000)})
    path.write_bytes(path.read_bytes()[:700])
    with pytest.raises(InputError, match=r"weights\.pth: not a file of tensors") as error:
        load_backbone(whole, 64)
    assert "\n" not in str(error.value)
    path.write_bytes(b"")
    with pytest.raises(InputError, match=r"weights\.pth: not a file of tensors"):
        load_backbone(whole, 64)


def test_code_in_a_weights_file_is_not_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "weights.pth"
    path.write_bytes(pickle.dumps(Exploit(), protocol=2))
    with pytest.raises(InputError, match="not a file of tensors"):
        load_backbone(weights_file("mobilenet_v2", "test", path), 64)
    assert not (tmp_path / "exploited").exists()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ([torch.zeros(1)], "not a state dict"),
        ({"a": 1}, "not a state dict"),
        ({"features.0.0.weight": torch.zeros(3)}, "not weights of mobilenet_v2"),
    ],
)
def test_weights_of_another_kind_are_refused(tmp_path, content, message):
    with pytest.raises(InputError, match=message):
        load_backbone(saved(tmp_path / "weights.pth", content), 64)


@pytest.mark.parametrize("name", NAMES)
def test_thawing(name):
    backbone = untrained_backbone(name, 64)
    count = sum(p.numel() for p in backbone.blocks.parameters())
    assert thaw(backbone, "none", 2) == []
    some = sum(p.numel() for p in thaw(backbone, "last_blocks", 2))
    last = sum(p.numel() for p in backbone.blocks[-2:].parameters())
    assert some == last < count
    assert sum(p.numel() for p in thaw(backbone, "all", 2)) == count
    assert not any(p.requires_grad for b in backbone.blocks[:0] for p in b.parameters())
