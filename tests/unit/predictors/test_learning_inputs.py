"""The record of the backbone, and inputs from features or images."""

import io

import numpy as np
import pytest
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.files import write_bytes, write_npz, zip_bytes
from grasptypes.predictors.learning_inputs import (
    read_backbone_record,
    read_inputs,
    recorded_weights,
    write_backbone_record,
)
from grasptypes.predictors.weights import WEIGHTS_VARIABLE, find_weights

TASKS = {"use": 10, "handoff": -10}


def test_the_record_knows_the_weights_but_not_where_they_lie(tmp_path, monkeypatch):
    (tmp_path / "a.pth").write_bytes(b"weights")
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(tmp_path / "a.pth"))
    write_backbone_record(find_weights(0), 224, tmp_path / "backbone.json")
    assert str(tmp_path) not in (tmp_path / "backbone.json").read_text()
    record = read_backbone_record(tmp_path / "backbone.json")
    assert recorded_weights(record).path == tmp_path / "a.pth"
    (tmp_path / "a.pth").write_bytes(b"others")
    with pytest.raises(InputError, match=r"a\.pth: is not the recorded a\.pth"):
        recorded_weights(record)


@pytest.mark.parametrize("content", ["", "[]", '{"backbone": 1}'])
def test_a_damaged_record_is_refused(tmp_path, content):
    (tmp_path / "backbone.json").write_text(content)
    with pytest.raises(InputError, match="not a backbone record"):
        read_backbone_record(tmp_path / "backbone.json")


def test_inputs_are_features_or_encoded_pictures(tmp_path):
    write_npz(tmp_path / "mug.npz", {"none": np.ones((2, 3), np.float32)})
    buffer = io.BytesIO()
    Image.fromarray(np.full((4, 4, 3), 250, np.uint8)).save(buffer, "PNG")
    write_bytes(tmp_path / "pan.zip", zip_bytes({"000.png": buffer.getvalue()}))
    inputs = read_inputs([tmp_path / "mug.npz", tmp_path / "pan.zip"], TASKS)
    assert inputs["mug"]["none"].shape == (2, 3)
    assert {name: int(p[0, 0, 0, 0]) for name, p in inputs["pan"].items()} == {
        "none": 250,
        "use": 255,
        "handoff": 240,
    }
