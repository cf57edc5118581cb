"""A learning problem read from the files of the workflow."""

import learning
import pytest

from grasptypes.errors import InputError
from grasptypes.files import write_npz
from grasptypes.labels.samples import SAMPLE_SCHEMA
from grasptypes.predictors.folds import FOLD_SCHEMA
from grasptypes.predictors.predictor import Architecture
from grasptypes.predictors.problem import read_problem
from grasptypes.predictors.weights import WEIGHTS_VARIABLE, BackboneRecord
from grasptypes.tables import write_table

TUNED = learning.SETTINGS.changed(finetune="all")


@pytest.fixture
def files(tmp_path, monkeypatch):
    """Features, samples, folds and the record of a backbone that has seen nothing."""
    weights = learning.random_weights(tmp_path / "random.pth")
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(weights.path))
    BackboneRecord.of(weights, 32).write(tmp_path / "backbone.json")
    for name, encoded in learning.features().items():
        write_npz(tmp_path / f"{name}.npz", encoded)
    write_table(learning.samples(), tmp_path / "samples.csv", SAMPLE_SCHEMA)
    write_table(learning.folds(), tmp_path / "folds.csv", FOLD_SCHEMA)
    return {
        "inputs": sorted(tmp_path.glob("*.npz")),
        "samples": tmp_path / "samples.csv",
        "folds": tmp_path / "folds.csv",
        "backbone": tmp_path / "backbone.json",
    }


def test_frozen_problems_need_no_backbone_and_others_bring_theirs(files):
    name = "simulated", "task_vector"
    frozen = read_problem(files, name, learning.TASKS, learning.SETTINGS)
    assert frozen.backbone is None
    assert frozen.examples.inputs.shape[1] == 24
    assert len(frozen.examples.inputs) == learning.VIEWS * len(learning.OBJECTS) * 3
    tuned = read_problem(files, name, learning.TASKS, TUNED)
    assert tuned.backbone is not None
    assert tuned.backbone.input_px == 32


def test_the_card_tells_what_the_predictor_needs_to_be_used(files):
    problem = read_problem(files, ("published", "task_in_image"), learning.TASKS, learning.SETTINGS)
    card = problem.card(Architecture(24, 0, (8, 8, 8), 6))
    assert (card.model, card.labels, card.finetune) == ("task_in_image", "published", "none")
    assert card.tasks == tuple(learning.TASKS)
    assert card.colour_shifts == dict(learning.TASKS)
    assert card.input_px == 32
    assert card.weights.startswith("random.pth")


def test_weights_other_than_the_recorded_are_refused(files, tmp_path, monkeypatch):
    (tmp_path / "other.pth").write_bytes(b"other")
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(tmp_path / "other.pth"))
    with pytest.raises(InputError, match=r"other\.pth: is not the recorded random\.pth"):
        read_problem(files, ("simulated", "no_task"), learning.TASKS, TUNED)
