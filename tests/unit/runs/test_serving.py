"""A logged model, loaded as MLflow's server loads it, says what the predictor says."""

import mlflow
import numpy as np
import pytest
from learning import ROOT, random_weights, small_predictor
from mlflow.exceptions import MlflowException
from test_publishing import RUN, TIMES_MS, store_in

from grasptypes.predictors.predictor_files import load_predictor
from grasptypes.renders.photos import padded
from grasptypes.runs.serving import MIN_PX
from grasptypes.runs.tracking import TrainedModel
from grasptypes.settings.params import read_params

PICTURES = np.random.default_rng(3).integers(0, 256, (2, 40, 80, 3), dtype=np.uint8)
TASKS = ["handoff", "wash"]


@pytest.fixture(scope="module")
def logged(tmp_path_factory):
    """The model that MLflow has logged, and the probabilities (2, 6) it should give."""
    root = tmp_path_factory.mktemp("model")
    weights = random_weights(root / "random.pth")
    small_predictor(root, weights)
    card, tensors = root / "predictor.json", root / "predictor.safetensors"
    model, store = TrainedModel(root, root, tensors, card, TIMES_MS, "barrett"), store_in(root)
    with store.opened():
        run = store.upsert(RUN)
        for _ in range(2):  # not logged twice
            store.log_model(run, model, weights.path, PICTURES[0])
    client = mlflow.MlflowClient(store.uri)
    assert client.get_run(run).info.end_time == TIMES_MS[1]  # of the training
    (found,) = client.search_logged_models([client.get_experiment_by_name("test").experiment_id])
    predictor = load_predictor(tensors, card, weights)
    pairs = zip(PICTURES, TASKS, strict=True)
    logits = [predictor.logits(padded(picture)[None], task)[0] for picture, task in pairs]
    powers = np.exp(logits)
    return mlflow.pyfunc.load_model(found.model_uri), powers / powers.sum(1, keepdims=True)


def ask(logged, tasks, pictures=PICTURES):
    return logged[0].predict({"image": pictures, "task": np.array(tasks)})


def test_it_says_what_the_predictor_says(logged):
    np.testing.assert_allclose(ask(logged, TASKS)["share"], logged[1], atol=1e-5)
    assert np.abs(np.diff(logged[1], axis=0)).max() > 0.01  # images and tasks that differ
    assert logged[0].metadata.saved_input_example_info is not None


def test_the_least_size_is_that_of_the_command():
    assert read_params(ROOT / "params.yaml").predict.photos.min_px == MIN_PX


@pytest.mark.parametrize(
    ("tasks", "pictures", "message"),
    [
        (["use"], PICTURES[:1, :20], "image is 80 x 20 pixels; each side needs at least 32"),
        (TASKS, PICTURES // 255, "values from 0 to 255 are needed"),
        (["use", "fly"], PICTURES, "fly: unknown; allowed: use, handoff, wash"),
        (["use"], PICTURES, "2 images, but 1 tasks"),
        (["use"], PICTURES[0], "image"),
    ],
)
def test_what_cannot_be_answered_is_refused_in_one_message(logged, tasks, pictures, message):
    with pytest.raises(MlflowException, match=message):
        ask(logged, tasks, pictures)
