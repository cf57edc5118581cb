"""The predictor for unseen objects as MLflow's server loads it."""

import mlflow
import numpy as np
import pytest
from mlflow.exceptions import MlflowException
from tests.unit.settings import PARAMS

from grasptypes.predictors.general_predictor import load_general
from grasptypes.predictors.prediction import Predictor
from grasptypes.runs.tracking import save_general

PICTURES = np.random.default_rng(7).integers(0, 256, (2, 60, 80, 3), dtype=np.uint8)
REQUEST = {
    "image": PICTURES,
    "task": np.array(["use", "pour"]),
    "size_m": np.array([[0.12, 0, 0], [0, 0, 0]]),
    "mass_kg": np.array([0.3, 0]),
    "box": np.array([[0, 0, 0, 0], [10, 10, 60, 50]]),
}


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
        ({"mass_kg": np.array([0.3])}, "as many size_m, mass_kg and box"),
        ({"image": PICTURES // 255}, "values from 0 to 255 are needed"),
    ],
)
def test_what_cannot_be_answered_is_refused_in_one_message(served, changes, message):
    with pytest.raises(MlflowException, match=message):
        served.predict(REQUEST | changes)
