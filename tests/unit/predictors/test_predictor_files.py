"""A predictor read back from disk answers as it did in training."""

from dataclasses import replace

import learning
import numpy as np
import pytest
import torch

from grasptypes.errors import InputError
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.features import extract
from grasptypes.predictors.predictor_files import ModelCard, load_predictor, write_predictor
from grasptypes.predictors.variants import VARIANTS

IMAGES = np.random.default_rng(0).integers(0, 256, (3, 40, 40, 3), dtype=np.uint8)


@pytest.fixture
def weights(tmp_path):
    return learning.random_weights(tmp_path / "random.pth")


@pytest.fixture
def files(tmp_path):
    return tmp_path / "predictor.safetensors", tmp_path / "predictor.json"


def shown_and_told(card, task):
    """The colour shift of the images, and the task vector of the head, for the card's model."""
    variant, vector = VARIANTS[card.model], None
    if variant.task_vector:
        vector = torch.zeros(1, len(IMAGES), len(card.tasks))
        vector[..., card.tasks.index(task)] = 1
    return card.colour_shifts[task] if variant.picture_shows_task else 0, vector


@pytest.mark.parametrize("model", VARIANTS)
def test_images_are_seen_as_the_features_that_were_learnt_from(files, weights, model):
    learning.small_predictor(files[0].parent, weights, model)
    card = ModelCard.read(files[1])
    predictor = load_predictor(*files, weights)
    logits = {}
    for task in card.tasks:
        shift, told = shown_and_told(card, task)
        backbone = load_backbone(weights, card.input_px)
        features = extract(backbone, IMAGES, {"shown": shift}, 3)["shown"]
        with torch.inference_mode():
            expected = predictor.head(torch.from_numpy(features)[None], told)[0].numpy()
        logits[task] = predictor.logits(IMAGES, task)
        np.testing.assert_array_equal(logits[task], expected)
    sees_task = model in ("task_vector", "task_in_image")
    assert np.array_equal(logits["use"], logits["handoff"]) != sees_task
    with pytest.raises(InputError, match="unknown; allowed: use, handoff, wash"):
        predictor.logits(IMAGES, "throw")


def test_a_fine_tuned_backbone_is_kept_with_its_head(files, weights):
    learning.small_predictor(files[0].parent, weights)
    predictor = load_predictor(*files, weights)
    tuned = load_backbone(weights, 32)
    with torch.no_grad():
        for parameter in tuned.blocks[-1].parameters():
            parameter += 0.1
    card = predictor.card.changed(finetune="last_blocks")
    write_predictor(predictor.head, tuned, card, *files)
    loaded = load_predictor(*files, weights)
    for name, tensor in loaded.backbone.state_dict().items():
        torch.testing.assert_close(tensor, tuned.state_dict()[name])
    assert not np.allclose(loaded.logits(IMAGES, "use"), predictor.logits(IMAGES, "use"))


def test_other_weights_and_damaged_files_are_rejected(files, weights):
    learning.small_predictor(files[0].parent, weights)
    with pytest.raises(InputError, match="trained on mobilenet_v2"):
        load_predictor(*files, replace(weights, sha256="0" * 64))
    files[0].write_bytes(files[0].read_bytes()[:-10])
    with pytest.raises(InputError, match=r"predictor\.safetensors"):
        load_predictor(*files, weights)
    renamed = files[1].read_text().replace('"finetune"', '"accuracy"')
    for damaged, said in (("{}", "is missing"), (renamed, "'accuracy' is not a known key")):
        files[1].write_text(damaged)
        with pytest.raises(InputError, match=said):
            ModelCard.read(files[1])
