"""The protocol, with a frozen and a fine-tuned backbone."""

from dataclasses import replace

import learning
import numpy as np
import pytest
import torch

from grasptypes.predictors.backbone import untrained_backbone
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.finetuning import fine_tune, predict_pictures
from grasptypes.predictors.members import Member, members_by_group
from grasptypes.predictors.protocol import train_final, try_splits
from grasptypes.predictors.scoring import CURVE_SCHEMA, PREDICTION_SCHEMA
from grasptypes.predictors.training import fit, predict
from grasptypes.predictors.variants import VARIANTS

KEY = ("predictor", "test")


def noisy_images():
    """Examples with images as bright as their object's number and their task's shift."""
    noise = np.random.default_rng(0).integers(-40, 40, (len(learning.OBJECTS), 20, 32, 32, 3))
    inputs = {
        name: {
            encoding: np.uint8(60 + 40 * i + shift + noise[i])
            for encoding, shift in ({"none": 0} | learning.TASKS).items()
        }
        for i, name in enumerate(learning.OBJECTS)
    }
    tables = learning.samples(), learning.folds()
    return assemble(VARIANTS["task_vector"], inputs, *tables, list(learning.TASKS))


def lively_backbone(examples):
    """A backbone of random weights, normalised so that its features vary with the images."""
    torch.manual_seed(0)
    backbone = untrained_backbone("mobilenet_v2", 32).train()
    for module in backbone.modules():
        if isinstance(module, torch.nn.BatchNorm2d):
            module.momentum = 1.0
    with torch.no_grad():
        backbone(torch.from_numpy(examples.inputs))
    return backbone.eval()


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
    examples = noisy_images()
    backbone = lively_backbone(examples)
    before = {name: tensor.clone() for name, tensor in backbone.state_dict().items()}
    settings = learning.SETTINGS.changed(finetune=finetune)
    members = [Member("0", 0, np.arange(0, 240, 10), np.arange(5, 240, 30))]
    outcome = try_splits(examples, members, settings, KEY, backbone)
    assert outcome.curves["train_loss"].notna().all()
    assert outcome.metrics["n_test"].tolist() == [8]
    for name, tensor in backbone.state_dict().items():
        torch.testing.assert_close(tensor, before[name])  # a copy is tuned
    few = replace(examples, inputs=examples.inputs[::10])
    tuned = train_final(few, settings, KEY, backbone)[1]
    changed = {
        int(name.split(".")[1])
        for name, parameter in tuned.named_parameters(remove_duplicate=False)
        if name.startswith("blocks.") and not torch.equal(parameter, before[name])
    }
    last = len(backbone.blocks) - 1
    assert changed == ({last} if finetune == "last_blocks" else set(range(last + 1)))


def test_fine_tuning_starts_from_the_head_of_the_frozen_backbone():
    examples = noisy_images()
    backbone = lively_backbone(examples)
    member = Member("0", 0, np.arange(0, 240, 10), np.arange(5, 240, 30))
    with torch.inference_mode():
        chunks = torch.from_numpy(examples.inputs).split(8)
        features = torch.cat([backbone(chunk) for chunk in chunks]).numpy()
    heads, _ = fit(replace(examples, inputs=features), [member], learning.SETTINGS, KEY)
    still = learning.SETTINGS.finetuning.changed(learning_rate=1e-12)
    settings = learning.SETTINGS.changed(finetune="last_blocks", finetuning=still)
    network, losses = fine_tune(backbone, examples, member, settings, KEY)
    tuned = predict_pictures(network, examples, member.test, 8)
    known = predict(heads, 0, replace(examples, inputs=features), member.test)
    np.testing.assert_allclose(tuned, known, atol=1e-3)
    assert losses[-1] == pytest.approx(losses[0], rel=1e-3)
