"""The record of the backbone, and inputs from features or images."""

import io

import numpy as np
import pytest
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.files import write_bytes, write_npz, zip_bytes
from grasptypes.predictors.features import read_inputs
from grasptypes.predictors.weights import WEIGHTS_VARIABLE, BackboneRecord, find_weights

TASKS = {"use": 10, "handoff": -10}


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


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("", "is not JSON"),
        ("[]", "is not a mapping"),
        ('{"backbone": 1}', "'weights' is missing|backbone: 1 is not text"),
    ],
)
def test_a_damaged_record_is_refused(tmp_path, content, said):
    (tmp_path / "backbone.json").write_text(content)
    with pytest.raises(InputError, match=said):
        BackboneRecord.read(tmp_path / "backbone.json")


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
