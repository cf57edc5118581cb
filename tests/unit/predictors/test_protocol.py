"""The protocol, with a frozen and a fine-tuned backbone."""

from dataclasses import replace

import learning
import numpy as np
import pytest
import torch

from grasptypes.predictors.backbone import untrained_backbone
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.members import Member, members_by_group
from grasptypes.predictors.protocol import train_final, try_splits
from grasptypes.predictors.scoring import CURVE_SCHEMA, PREDICTION_SCHEMA
from grasptypes.predictors.variants import VARIANTS

KEY = ("predictor", "test")


def grey_images():
    """Examples with images as bright as their object's number and their task's shift."""
    inputs = {
        name: {
            encoding: np.full((20, 32, 32, 3), 60 + 40 * i + shift, dtype=np.uint8)
            for encoding, shift in ({"none": 0} | learning.TASKS).items()
        }
        for i, name in enumerate(learning.OBJECTS)
    }
    tables = learning.samples(), learning.folds()
    return assemble(VARIANTS["task_vector"], inputs, *tables, list(learning.TASKS))


def test_frozen_tables_hold_a_row_a_fold_and_seed_and_a_prediction_a_test_example():
    examples = learning.examples("no_task")
    members = members_by_group(examples.index["fold"], 2)
    outcome = try_splits(examples, members, learning.SETTINGS.changed(epochs=3), KEY)
    assert len(outcome.metrics) == 4 * 2
    assert len(CURVE_SCHEMA.validate(outcome.curves)) == 4 * 2 * 3
    assert len(PREDICTION_SCHEMA.validate(outcome.predictions)) == 2 * len(examples.inputs)
    per_seed = outcome.predictions.groupby(["seed", "object", "view", "task"]).size()
    assert (per_seed == 1).all()


@pytest.mark.parametrize("finetune", ["last_blocks", "all"])
def test_fine_tuning_changes_the_blocks_it_names(finetune):
    backbone = untrained_backbone("mobilenet_v2", 32).eval()
    before = {name: tensor.clone() for name, tensor in backbone.state_dict().items()}
    settings = learning.SETTINGS.changed(finetune=finetune)
    examples = grey_images()
    members = [Member("0", 0, np.arange(0, 240, 10), np.arange(5, 240, 30))]
    outcome = try_splits(examples, members, settings, KEY, backbone)
    assert outcome.curves["train_loss"].notna().all()
    assert outcome.metrics["n_test"].tolist() == [8]
    for name, tensor in backbone.state_dict().items():
        torch.testing.assert_close(tensor, before[name])  # a copy is tuned
    few = replace(examples, inputs=examples.inputs[:16])
    tuned = train_final(few, settings, KEY, backbone)[1]
    changed = {
        int(name.split(".")[1])
        for name, parameter in tuned.named_parameters(remove_duplicate=False)
        if name.startswith("blocks.") and not torch.equal(parameter, before[name])
    }
    last = len(backbone.blocks) - 1
    assert changed == ({last} if finetune == "last_blocks" else set(range(last + 1)))
