"""The predictor for unseen objects as MLflow's server loads it."""

import io
import json
from base64 import b64encode

import mlflow
import numpy as np
import pytest
from mlflow.exceptions import MlflowException
from PIL import Image
from tests.unit.settings import PARAMS

from grasptypes.predictors.general_predictor import load_general
from grasptypes.predictors.prediction import Predictor
from grasptypes.renders.depth_images import Intrinsics
from grasptypes.runs.tracking import save_general

PICTURES = np.random.default_rng(7).integers(0, 256, (2, 60, 80, 3), dtype=np.uint8)
REQUEST = {
    "image": PICTURES,
    "task": np.array(["use", "pour"]),
    "size_m": np.array([[0.12, 0, 0], [0, 0, 0]]),
    "mass_kg": np.array([0.3, 0]),
    "box": np.array([[0, 0, 0, 0], [10, 10, 60, 50]]),
    **{name: np.array(["", ""]) for name in ("mask", "depth", "intrinsics")},
}
MASK = np.zeros((60, 80), dtype=bool)
MASK[15:50, 20:61] = True
# A plate half a metre away, 41 pixels across, that a camera of 100 pixels' focal length sees.
DEPTH_MM = np.where(MASK, 500, 0).astype(np.uint16)
CAMERA = {"fx": 100, "fy": 100, "cx": 40, "cy": 30}


def png(array):
    buffer = io.BytesIO()
    Image.fromarray(array).save(buffer, "png")
    return b64encode(buffer.getvalue()).decode()


def npy(array):
    buffer = io.BytesIO()
    np.save(buffer, array)
    return b64encode(buffer.getvalue()).decode()


def second(**texts):
    """The request, with something for the second image instead of a box and a size."""
    columns = {name: np.array(["", text]) for name, text in texts.items()}
    return REQUEST | {"box": np.zeros((2, 4), dtype=int)} | columns


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    folder = tmp_path_factory.mktemp("model") / "general"
    save_general(folder, PARAMS)
    return mlflow.pyfunc.load_model(str(folder))


def test_it_says_what_the_predictor_says(served):
    predictor = Predictor(load_general(), PARAMS)
    answers = [
        predictor.predict(PICTURES[0], "use", size_m=0.12, mass_kg=0.3),
        predictor.predict(PICTURES[1], "pour", box=(10, 10, 60, 50)),
    ]
    told = served.predict(REQUEST)
    for number, answer in enumerate(answers):
        assert sorted(told["probability"][number]) == pytest.approx(
            sorted(answer.probabilities.values()), abs=1e-5
        )
        assert told["share"][number].sum() == pytest.approx(1, abs=1e-5)
        assert told["strangeness"][number] == pytest.approx(answer.strangeness, abs=1e-4)
        assert list(told["neighbours"][number]) == [one.name for one in answer.neighbours]
    assert served.metadata.saved_input_example_info is not None


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"task": np.array(["use", "fly"])}, "fly: unknown; allowed: use"),
        ({"size_m": np.full((2, 3), 3000.0)}, "3000 m: must be 0.001 to 2 m"),
        ({"box": np.array([[0, 0, 0, 0], [0, 0, 99, 50]])}, "is not a part of the image"),
        ({"mass_kg": np.array([0.3])}, "2 images need as many of each: size_m, mass_kg, box"),
        (second(mask="ä"), "mask: is not base64"),
        (second(mask=png(DEPTH_MM)), "^mask: "),
        (second(mask=png(MASK[1:])), "^mask: has 80 x 59 pixels"),
        (second(mask=png(MASK), depth=png(DEPTH_MM)), "needs --intrinsics"),
        (second(mask=png(MASK), depth=png(DEPTH_MM), intrinsics="{}"), "^intrinsics: has no"),
        ({"image": PICTURES // 255}, "values from 0 to 255 are needed"),
    ],
)
def test_what_cannot_be_answered_is_refused_in_one_message(served, changes, message):
    with pytest.raises(MlflowException, match=message):
        served.predict(REQUEST | changes)


@pytest.mark.parametrize("depth", [png(DEPTH_MM), npy(DEPTH_MM / 1000)])
def test_masks_and_depth_images_come_as_files_in_base64(served, depth):
    answer = Predictor(load_general(), PARAMS).predict(
        PICTURES[1],
        "pour",
        mask=MASK,
        depth=DEPTH_MM / 1000,
        intrinsics=Intrinsics((100.0, 100.0), (40.0, 30.0)),
    )
    asked = second(mask=png(MASK), depth=depth, intrinsics=json.dumps(CAMERA))
    told = served.predict(asked)["probability"][1]
    assert sorted(told) == pytest.approx(sorted(answer.probabilities.values()), abs=1e-5)
    sizeless = served.predict(second(mask=png(MASK)))["probability"][1]
    assert np.abs(sizeless - told).max() > 0.01
