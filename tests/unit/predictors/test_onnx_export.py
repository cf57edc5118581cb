"""The exported file answers as the predictor does."""

import numpy as np
import pytest
import torch
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.predictors import onnx_export
from grasptypes.predictors.general_predictor import load_general
from grasptypes.predictors.onnx_export import INPUTS, GeneralModule
from grasptypes.predictors.prediction import Predictor
from grasptypes.settings.tasks import read_tasks

PICTURES = np.random.default_rng(5).integers(0, 256, (3, 224, 224, 3), dtype=np.uint8)
FACTS = [
    [np.log(0.1), np.nan, np.nan, np.nan],
    [np.log(0.3), np.log(0.1), np.log(0.05), np.log(0.7)],
    [np.nan] * 4,
]
TASKS = ("use", "handoff", "pour")


@pytest.fixture(scope="module")
def network():
    return load_general()


@pytest.fixture(scope="module")
def fed(network):
    coordinates = [network.code(read_tasks()[task]) for task in TASKS]
    arrays = PICTURES, np.array(FACTS, np.float32), np.array(coordinates, np.float32)
    return dict(zip(INPUTS, arrays, strict=True))


def assert_same(network, told):
    for number, task in enumerate(TASKS):
        one = PICTURES[number : number + 1]
        shares, occurs = network.answers(one, task, FACTS[number])
        np.testing.assert_allclose(told[0][number], occurs[0], atol=1e-3)
        np.testing.assert_allclose(told[1][number], shares[0], atol=1e-3)


def test_the_module_answers_as_the_predictor(network, fed):
    with torch.inference_mode():
        told = GeneralModule(network).eval()(*map(torch.from_numpy, fed.values()))
    assert_same(network, told)


def test_onnxruntime_answers_as_the_predictor(network, fed, tmp_path):
    pytest.importorskip("onnx", reason="the extra onnx is not installed")
    onnxruntime = pytest.importorskip("onnxruntime", reason="the extra onnx is not installed")
    Predictor(network, PARAMS).export(tmp_path / "general.onnx")
    session = onnxruntime.InferenceSession(tmp_path / "general.onnx")
    assert_same(network, session.run(None, fed))
    assert [one.name for one in session.get_inputs()] == list(INPUTS)


def test_a_missing_package_is_named(network, tmp_path, monkeypatch):
    monkeypatch.setattr(onnx_export, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"pip install 'grasptypes\[onnx\]'"):
        Predictor(network, PARAMS).export(tmp_path / "general.onnx")
