"""Which known kinds look alike, and what looks like none of them."""

import numpy as np
import pytest
from tests.unit.settings import PARAMS

from grasptypes.predictors.general_inputs import Pictures
from grasptypes.predictors.general_predictor import TRAINED
from grasptypes.predictors.known_kinds import (
    KNOWN,
    LOOKS,
    learn_kinds,
    read_kinds,
    read_looks,
    write_kinds,
    write_looks,
)

SETTINGS = PARAMS.predict.known_kinds.changed(directions=8, last_features=20, folds=4)
NAMES = [f"{name}_s01" for name in ("ball", "cup", "fork", "jar", "key", "mop", "pin", "saw")]
FEATURES = 30


@pytest.fixture(scope="module")
def shown():
    """Six images of each kind: a direction a kind, with noise."""
    rng = np.random.default_rng(0)
    objects = np.repeat(NAMES, 6)
    places = FEATURES - 1 - np.repeat(np.arange(len(NAMES)), 6)
    rows = rng.normal(0, 0.2, (len(objects), FEATURES)) + 3 * np.eye(FEATURES)[places]
    return Pictures(objects, rows.astype(np.float32), np.zeros((len(objects), 1)))


@pytest.fixture(scope="module")
def known(shown):
    return learn_kinds(shown, {name: frozenset([name]) for name in NAMES}, SETTINGS, "w", 0)


def test_the_kind_itself_is_the_nearest(shown, known):
    for name in NAMES:
        near = known.nearest(shown.of([name]).features, 3)
        assert near[0].name == name.removesuffix("_s01")
        assert near[0].similarity > 0.9 > near[1].similarity >= near[2].similarity


def test_images_of_something_else_are_strange(shown, known):
    assert (known.strangeness(shown.features) > 1).mean() <= 0.1
    assert (known.strangeness(20 * shown.features.mean(0) - shown.features) > 1).all()


def test_a_written_file_says_nearly_the_same(shown, known, tmp_path):
    write_kinds(known, tmp_path / KNOWN)
    again = read_kinds(tmp_path / KNOWN)
    assert again.weights == "w"
    rows = shown.features
    np.testing.assert_allclose(again.strangeness(rows), known.strangeness(rows), rtol=2e-3)
    assert [n.name for n in again.nearest(rows[:6], 3)] == [
        n.name for n in known.nearest(rows[:6], 3)
    ]


def test_small_images_come_back_by_the_kind(tmp_path):
    red = np.full((64, 64, 3), (200, 10, 10), dtype=np.uint8)
    write_looks({"cup_s01": red, "mug": red // 2}, 16, tmp_path / LOOKS)
    cup, mug = read_looks(["cup", "mug"], tmp_path / LOOKS)
    assert cup.shape == (16, 16, 3)
    assert np.abs(cup.mean((0, 1)) - red[0, 0]).max() < 10
    assert mug[0, 0, 0] < cup[0, 0, 0]


def test_the_package_has_an_image_of_each_kind_it_knows_in_few_bytes():
    known = read_kinds(TRAINED / KNOWN)
    looks = read_looks(known.names.tolist(), TRAINED / LOOKS)
    assert {look.shape for look in looks} == {(96, 96, 3)}
    assert sum(path.stat().st_size for path in TRAINED.iterdir()) < 5e6
