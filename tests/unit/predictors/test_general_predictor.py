"""The predictor that comes with the package: it answers at once, and size, mass and task matter."""

import json

import numpy as np
import pytest
from PIL import Image
from tests.unit.settings import PARAMS

from grasptypes.__main__ import main
from grasptypes.errors import InputError
from grasptypes.files import file_sha256
from grasptypes.predictors.general_predictor import (
    CARD,
    HEAD,
    TRAINED,
    GeneralCard,
    load_general,
    write_general,
)
from grasptypes.predictors.known_size import facts_of_size
from grasptypes.predictors.prediction import Predictor, report

PICTURE = np.random.default_rng(2).integers(0, 256, (64, 64, 3), dtype=np.uint8)


@pytest.fixture(scope="module")
def predictor():
    return Predictor(load_general(), PARAMS)


def test_size_mass_and_task_change_the_answer_which_is_made_of_probabilities(predictor):
    asked = [
        {"task": "use"},
        {"task": "handoff"},
        {"task": "use", "size_m": [0.03]},
        {"task": "use", "size_m": [0.25, 0.2, 0.2]},
        {"task": "use", "size_m": [0.25, 0.2, 0.2], "mass_kg": 2.0},
    ]
    answers = [predictor.predict(PICTURE, **said) for said in asked]
    assert len({answer.probability.round(4).tobytes() for answer in answers}) == len(asked)
    for answer in answers:
        assert answer.probability.sum() == pytest.approx(1)
        assert 0 < answer.sigmoid.min() < answer.sigmoid.max() < 1
    small, large = (dict(zip(a.types, a.probability, strict=True)) for a in answers[2:4])
    assert small["precision"] > large["precision"]


def test_it_answers_for_tasks_that_it_has_not_learned(predictor):
    assert "pour" not in predictor.card.learned
    assert predictor.predict(PICTURE, "pour").probability.sum() == pytest.approx(1)
    answer = predictor.predict(PICTURE, "pour")
    assert "task pour, which it has not learned" in report([answer], predictor.card, "pour")
    assert "not learned" not in report([answer], predictor.card, "use")
    with pytest.raises(InputError, match="--task: is needed"):
        predictor.predict(PICTURE)


def test_the_command_needs_no_training(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Image.fromarray(PICTURE).save("photo.png")
    main(["predict", "--image", "photo.png", "--task", "use", "--size-m", "0.1", "--json"])
    told = json.loads(capsys.readouterr().out)
    assert told["model"] == "general"
    assert sum(told["answers"][0]["probability"].values()) == pytest.approx(1)


def test_a_written_head_is_the_one_that_is_read(predictor, tmp_path):
    network = predictor.model
    write_general(network.head, network.code, network.card, tmp_path / HEAD, tmp_path / CARD)
    assert file_sha256(tmp_path / HEAD) == file_sha256(TRAINED / HEAD)
    assert GeneralCard.read(tmp_path / CARD) == network.card


def test_other_weights_are_refused(predictor, tmp_path):
    network = predictor.model
    card = network.card.changed(weights="others (00000000)")
    write_general(network.head, network.code, card, tmp_path / HEAD, tmp_path / CARD)
    with pytest.raises(InputError, match=r"weights: learned with others \(00000000\)"):
        load_general(tmp_path)


def test_unknown_numbers_are_missing():
    facts = facts_of_size([0.1], None, PARAMS.predict)
    assert facts[0] == pytest.approx(np.log(0.1))
    assert np.isnan(facts[1:]).all()
    assert facts_of_size([0.1, 0.3, 0.2], 0.5, PARAMS.predict) == pytest.approx(
        np.log([0.3, 0.2, 0.1, 0.5])
    )
