"""A predictor read back answers as it did in training."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from learning import random_weights, small_predictor

from grasptypes.errors import InputError
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.features import extract
from grasptypes.predictors.predictor_files import load_predictor, read_card, write_predictor


@pytest.mark.parametrize("precision", ["bf16", "fp32"])
@pytest.mark.parametrize("model", ["task_vector", "task_in_image"])
def test_it_sees_pictures_as_the_features_that_it_learnt_from_were_made(tmp_path, model, precision):
    weights = random_weights(tmp_path / "random.pth")
    small_predictor(tmp_path, weights, model)
    files = tmp_path / "predictor.safetensors", tmp_path / "predictor.json"
    drawn = load_predictor(*files, weights)
    card = replace(read_card(files[1]), precision=precision)
    write_predictor(drawn.head, None, card, *files)
    predictor = load_predictor(*files, weights)
    pictures = np.random.default_rng(0).integers(0, 256, (3, 40, 40, 3), dtype=np.uint8)
    shift = card.colour_shifts["handoff"] if model == "task_in_image" else 0
    backbone = load_backbone(weights, card.input_px)
    features = extract(backbone, pictures, {"shown": shift}, precision, 3)["shown"]
    task = None
    if model == "task_vector":
        task = torch.zeros(1, 3, len(card.tasks))
        task[..., card.tasks.index("handoff")] = 1
    with torch.inference_mode():
        expected = predictor.head(torch.from_numpy(features)[None], task)[0].numpy()
    np.testing.assert_array_equal(predictor.logits(pictures, "handoff"), expected)


def test_precisions_can_be_told_apart(tmp_path):
    weights = random_weights(tmp_path / "random.pth")
    pictures = np.random.default_rng(0).integers(0, 256, (3, 40, 40, 3), dtype=np.uint8)
    backbone = load_backbone(weights, 32)
    fine, coarse = (extract(backbone, pictures, {"": 0}, p, 3)[""] for p in ("fp32", "bf16"))
    assert not np.array_equal(fine, coarse)


def test_a_card_without_precision_is_refused(tmp_path):
    weights = random_weights(tmp_path / "random.pth")
    small_predictor(tmp_path, weights)
    path = tmp_path / "predictor.json"
    path.write_text(path.read_text().replace('"precision"', '"accuracy"'))
    with pytest.raises(InputError, match="not a predictor's card"):
        read_card(path)
