"""Which known kinds look alike, and their small images."""

import numpy as np
from tests.unit.settings import PARAMS

from grasptypes.predictors.general_inputs import Inputs, Targets
from grasptypes.predictors.general_predictor import TRAINED, load_general
from grasptypes.predictors.known_kinds import LOOKS, nearest, read_looks, write_looks
from grasptypes.predictors.memory import Memory


def test_the_kind_itself_is_the_nearest_and_each_kind_occurs_once():
    names = np.array(["cup_s01", "cup_s02", "fork_s01", "mug"])
    looks = np.array([[9, 1.0, 0.0], [9, 0.9, 0.2], [9, 0.0, 1.0], [9, -1.0, -1.0]])
    inputs = Inputs(looks, np.zeros((4, 0)), np.zeros((4, 4)), np.zeros((4, 1)), np.ones(4))
    types = np.eye(4)
    memory = Memory.of(inputs, Targets(types, types, np.ones(4), names), PARAMS.general.head.memory)
    near = nearest(memory, np.array([[0, 2.0, 0.0], [0, 2.0, 0.1]]), 3)
    assert [one.name for one in near] == ["cup", "fork", "mug"]
    assert near[0].similarity > 0.99 > 0.1 > near[1].similarity > 0 > near[2].similarity


def test_small_images_come_back_by_the_kind(tmp_path):
    red = np.full((64, 64, 3), (200, 10, 10), dtype=np.uint8)
    write_looks({"cup_s01": red, "mug": red // 2}, 16, tmp_path / LOOKS)
    cup, mug = read_looks(["cup", "mug"], tmp_path / LOOKS)
    assert cup.shape == (16, 16, 3)
    assert np.abs(cup.mean((0, 1)) - red[0, 0]).max() < 10
    assert mug[0, 0, 0] < cup[0, 0, 0]


def test_the_package_has_an_image_of_each_kind_it_knows_in_few_bytes():
    network = load_general()
    memory, width = network.head.memory, len(network.head.features.middle)
    known = nearest(memory, np.ones((1, width)), len(memory.objects))
    looks = read_looks([one.name for one in known], TRAINED / LOOKS)
    assert {look.shape for look in looks} == {(96, 96, 3)}
    assert sum(path.stat().st_size for path in TRAINED.iterdir()) < 5e6
