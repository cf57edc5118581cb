"""Answers are frozen and sorted; their JSON meets the schema in docs, which is up to date."""

import json
from dataclasses import FrozenInstanceError

import jsonschema
import numpy as np
import pytest
from learning import ROOT

from grasptypes.labels.samples import TYPES
from grasptypes.predictors.answers import PLACE, Answer, AnswersRecord, described, report
from grasptypes.predictors.general_predictor import CARD, TRAINED, GeneralCard

SHARES = np.array([0.1, 0.2, 0.1, 0.3, 0.2, 0.1])
CHANCES = np.array([0.3, 0.8, 0.1, 0.6, 0.4, 0.2])
GENERAL = GeneralCard.read(TRAINED / CARD)


def test_types_are_sorted_and_some_are_chosen():
    answer = Answer.of("cup", TYPES, SHARES, CHANCES)
    assert list(answer.probabilities)[:2] == ["Medium Wrap", "Power Sphere"] == list(answer.chosen)
    assert list(answer.shares) == list(answer.probabilities)
    assert answer.confidence == pytest.approx(4.4 / 6)
    with pytest.raises(FrozenInstanceError):
        answer.name = "mug"
    unsure = Answer.of("cup", TYPES, SHARES, CHANCES / 2)
    assert unsure.chosen == ("Power Sphere",)  # the largest share


def test_the_json_meets_the_schema():
    schema = json.loads((ROOT / PLACE).read_text())
    assert schema == AnswersRecord.model_json_schema()
    answer = Answer.of("cup", TYPES, SHARES, CHANCES)
    for task in ("use", "pour"):
        told = described([answer], GENERAL, task).model_dump(mode="json")
        jsonschema.validate(told, schema)
        assert told["task_learned"] == (task == "use")
    told["version"] = "grasptypes.answers/2"
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(told, schema)


def test_doubts_are_the_last_lines_of_a_report():
    answer = Answer.of("cup", TYPES, SHARES, CHANCES)
    odd = Answer("mug", answer.probabilities, answer.shares, warnings=("nothing is like it",))
    assert report([odd], GENERAL, "use").splitlines()[-1] == "warning: nothing is like it"
    assert report([answer, odd], GENERAL, "use").endswith("warning: mug: nothing is like it\n")
