"""Encodings of the task and features of images."""

import io

import numpy as np
import pytest
from PIL import Image

from grasptypes.files import write_bytes, write_npz, zip_bytes
from grasptypes.predictors.backbone import KINDS, untrained_backbone
from grasptypes.predictors.features import (
    encodings,
    extract,
    read_inputs,
    shift_colours,
)

TASKS = {"use": 10, "handoff": -10, "show": 5}


def png(picture):
    buffer = io.BytesIO()
    Image.fromarray(picture).save(buffer, "PNG")
    return buffer.getvalue()


@pytest.fixture
def pictures():
    return np.random.default_rng(0).integers(0, 256, (3, 40, 40, 3), dtype=np.uint8)


def test_the_shift_is_clipped():
    shifted = shift_colours(np.array([0, 9, 100, 250], dtype=np.uint8), 10)
    np.testing.assert_array_equal(shifted, [10, 19, 110, 255])
    shifted = shift_colours(np.array([0, 9, 100, 250], dtype=np.uint8), -10)
    np.testing.assert_array_equal(shifted, [0, 0, 90, 240])
    assert shifted.dtype == np.uint8


def test_inputs_are_features_or_encoded_pictures(tmp_path):
    write_npz(tmp_path / "mug.npz", {"none": np.ones((2, 3), np.float32)})
    picture = png(np.full((4, 4, 3), 250, np.uint8))
    write_bytes(tmp_path / "pan.zip", zip_bytes({"000.png": picture}))
    inputs = read_inputs([tmp_path / "mug.npz", tmp_path / "pan.zip"], TASKS)
    assert inputs["mug"]["none"].shape == (2, 3)
    assert {name: int(p[0, 0, 0, 0]) for name, p in inputs["pan"].items()} == {
        "none": 250,
        "use": 255,
        "handoff": 240,
        "show": 255,
    }


def test_features_of_each_encoding(pictures):
    backbone = untrained_backbone("mobilenet_v2", 64)
    shifts = encodings(TASKS)
    features = extract(backbone, pictures, shifts, 2)
    assert {name: f.shape for name, f in features.items()} == dict.fromkeys(
        shifts, (3, KINDS["mobilenet_v2"].features)
    )
    shifted = extract(backbone, shift_colours(pictures, 5), {"none": 0}, 3)
    np.testing.assert_allclose(features["show"], shifted["none"], atol=1e-5)
    again = extract(backbone, pictures, shifts, 2)
    np.testing.assert_array_equal(features["use"], again["use"])
