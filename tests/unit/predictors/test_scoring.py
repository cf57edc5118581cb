"""Rows of metrics, predictions and losses, one a member."""

import numpy as np
import pandas as pd

from grasptypes.labels.samples import TYPES
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import Member
from grasptypes.predictors.scoring import PREDICTION_SCHEMA, score


def test_every_member_is_scored_on_its_own_test_examples():
    labels = np.eye(6)[[0, 1, 2]]
    index = pd.DataFrame({"object": ["mug", "pan", "bowl"], "view": [0, 1, 2], "task": "use"})
    examples = Examples(index, np.zeros((3, 1), np.float32), None, labels, labels, labels[:, ::-1])
    members = [
        Member("0", 0, np.array([2]), np.array([0, 1])),
        Member("1", 7, np.array([0, 1]), np.array([2])),
    ]
    certain = np.where(labels, 40.0, -40.0)
    metrics, predictions = score(examples, members, [certain[:2], certain[:1]])
    assert metrics[["group", "seed", "n_train", "n_test"]].to_numpy().tolist() == [
        ["0", 0, 1, 2], ["1", 7, 2, 1],
    ]  # fmt: skip
    assert metrics["multilabel_accuracy"].tolist() == [1.0, 0.0]
    assert np.allclose(metrics["angular_similarity"], [1, 0], atol=1e-6)
    assert np.allclose(metrics["frequency_similarity"], 0, atol=1e-6)  # of other types here
    PREDICTION_SCHEMA.validate(predictions)
    assert predictions["object"].tolist() == ["mug", "pan", "bowl"]
    assert predictions["seed"].tolist() == [0, 0, 7]
    assert predictions[f"logit_{TYPES[0]}"].tolist() == [40, -40, 40]
