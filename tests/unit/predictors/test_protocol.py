"""The protocol, frozen and fine-tuned, and the final predictor on disk."""

from dataclasses import replace

import learning
import numpy as np
import pytest
import torch

from grasptypes.errors import InputError
from grasptypes.labels.samples import TYPES
from grasptypes.predictors.backbone import KINDS, untrained_backbone
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.predictor import VARIANTS, Architecture, BatchedMLP
from grasptypes.predictors.predictor_files import (
    ModelCard,
    load_predictor,
    read_card,
    write_predictor,
)
from grasptypes.predictors.protocol import train_final, try_splits
from grasptypes.predictors.scoring import CURVE_SCHEMA, PREDICTION_SCHEMA
from grasptypes.predictors.training import Member, members_by_group
from grasptypes.predictors.weights import weights_file

KEY = ("predictor", "test")


@pytest.fixture(scope="module")
def weights(tmp_path_factory):
    """Weights of a MobileNetV2 that has seen nothing."""
    torch.manual_seed(0)
    path = tmp_path_factory.mktemp("weights") / "random.pth"
    stem = untrained_backbone("mobilenet_v2", 32).blocks.state_dict()
    state = {f"features.{name}": tensor for name, tensor in stem.items()}
    state |= {
        "classifier.1.weight": torch.zeros(1000, 1280),
        "classifier.1.bias": torch.zeros(1000),
    }
    torch.save(state, path)
    return weights_file("mobilenet_v2", "test", path)


def pictures(model):
    """Grey pictures, as bright as their object's number and their task's shift."""
    tasks = dict(learning.TASKS)
    inputs = {
        name: {
            encoding: np.full((20, 32, 32, 3), 60 + 40 * i + shift, dtype=np.uint8)
            for encoding, shift in ({"none": 0} | tasks).items()
        }
        for i, name in enumerate(learning.OBJECTS)
    }
    return assemble(VARIANTS[model], inputs, learning.samples(), learning.folds(), list(tasks))


def card(architecture, weights, model="task_vector", finetune="none"):
    shifts = dict(learning.TASKS)
    return ModelCard(
        model,
        "simulated",
        TYPES,
        tuple(shifts),
        shifts,
        architecture,
        weights.backbone,
        weights.name,
        32,
        finetune,
        "fp32",
    )


def test_frozen_tables_hold_a_row_a_fold_and_seed_and_a_prediction_a_test_example():
    examples = learning.examples("no_task")
    members = members_by_group(examples.index["fold"], 2)
    quick = learning.SETTINGS.changed(epochs=3)
    outcome = try_splits(examples, members, quick, KEY)
    assert len(outcome.metrics) == 4 * 2
    assert len(CURVE_SCHEMA.validate(outcome.curves)) == 4 * 2 * 3
    assert len(PREDICTION_SCHEMA.validate(outcome.predictions)) == 2 * len(examples.inputs)
    per_seed = outcome.predictions.groupby(["seed", "object", "view", "task"]).size()
    assert (per_seed == 1).all()


@pytest.mark.parametrize("finetune", ["last_blocks", "all"])
def test_fine_tuning_changes_the_blocks_it_names(weights, finetune):
    backbone = untrained_backbone("mobilenet_v2", 32).eval()
    before = {name: tensor.clone() for name, tensor in backbone.state_dict().items()}
    settings = learning.SETTINGS.changed(finetune=finetune)
    examples = pictures("task_vector")
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


def test_a_fine_tuned_predictor_survives_the_disk(weights, tmp_path):
    settings = learning.SETTINGS.changed(finetune="last_blocks")
    examples = pictures("task_vector")
    few = replace(examples, inputs=examples.inputs[:16])
    backbone = untrained_backbone("mobilenet_v2", 32).eval()
    backbone.blocks.load_state_dict(
        {k.removeprefix("features."): v for k, v in torch.load(weights.path).items() if "feat" in k}
    )
    heads, tuned = train_final(few, settings, KEY, backbone)
    files = tmp_path / "predictor.safetensors", tmp_path / "predictor.json"
    write_predictor(heads, tuned, card(heads.architecture, weights, finetune="last_blocks"), *files)
    loaded = load_predictor(*files, weights)
    shown = examples.inputs[:3]
    vector = torch.eye(3)[[1, 1, 1]]
    with torch.inference_mode():
        expected = heads(tuned(torch.from_numpy(shown))[None], vector[None])[0].numpy()
    np.testing.assert_allclose(loaded.logits(shown, "handoff"), expected, atol=1e-5)


@pytest.mark.parametrize("model", VARIANTS)
def test_a_predictor_from_the_disk_answers_as_the_one_that_was_trained(weights, tmp_path, model):
    tasks = 3 if model == "task_vector" else 0
    sizes = learning.SETTINGS.hidden
    heads = BatchedMLP(
        Architecture(KINDS["mobilenet_v2"].features, tasks, sizes, len(TYPES)), [("a",)]
    ).eval()
    files = tmp_path / "predictor.safetensors", tmp_path / "predictor.json"
    write_predictor(heads, None, card(heads.architecture, weights, model), *files)
    assert read_card(files[1]) == card(heads.architecture, weights, model)
    loaded = load_predictor(*files, weights)
    shown = np.random.default_rng(0).integers(0, 256, (2, 32, 32, 3), dtype=np.uint8)
    logits = {task: loaded.logits(shown, task) for task in learning.TASKS}
    told = model in ("task_vector", "task_in_image")
    assert np.array_equal(logits["use"], logits["handoff"]) != told
    with pytest.raises(InputError, match="unknown; allowed: use, handoff, show"):
        loaded.logits(shown, "throw")


def test_other_weights_and_damaged_files_are_refused(weights, tmp_path):
    heads = BatchedMLP(
        Architecture(KINDS["mobilenet_v2"].features, 0, (4, 4, 4), len(TYPES)), [("a",)]
    )
    files = tmp_path / "predictor.safetensors", tmp_path / "predictor.json"
    write_predictor(heads, None, card(heads.architecture, weights, "no_task"), *files)
    with pytest.raises(InputError, match="trained on mobilenet_v2"):
        load_predictor(*files, replace(weights, sha256="0" * 64))
    files[0].write_bytes(files[0].read_bytes()[:-10])
    with pytest.raises(InputError, match=r"predictor\.safetensors"):
        load_predictor(*files, weights)
    files[1].write_text("{}")
    with pytest.raises(InputError, match="not a predictor's card"):
        read_card(files[1])
