"""What a user shows, asked through the library: parts, several images, depth, points, threads."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import trimesh
from PIL import ExifTags, Image
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.predictors.general_predictor import load_general
from grasptypes.predictors.known_size import read_size
from grasptypes.predictors.prediction import Predictor
from grasptypes.predictors.shown import Hints, look
from grasptypes.renders.depth_images import Intrinsics

NOISE = np.random.default_rng(4).integers(0, 256, (96, 128, 3), dtype=np.uint8)
BOX = 20, 10, 80, 70
MASK = np.zeros(NOISE.shape[:2], dtype=bool)
MASK[10:70, 20:80] = True
SMALL = PARAMS.changed(
    predict=PARAMS.predict.changed(views=2), renders=PARAMS.renders.changed(size_px=96)
)


@pytest.fixture(scope="module")
def predictor():
    return Predictor(load_general(), SMALL)


def test_box_mask_and_crop_are_the_same(predictor, tmp_path):
    Image.fromarray(NOISE).save(tmp_path / "cup.png")
    Image.fromarray(np.uint8(255 * MASK)).save(tmp_path / "mask.png")
    path = tmp_path / "cup.png"
    told = [
        predictor.predict(NOISE[10:70, 20:80], "use"),
        predictor.predict(path, "use", box=BOX),
        predictor.predict(path, "use", mask=tmp_path / "mask.png"),
        predictor.predict(NOISE, "use", mask=MASK),
    ]
    assert [answer.probabilities for answer in told[1:]] == [told[0].probabilities] * 3
    assert predictor.predict(path, "use").probabilities != told[0].probabilities


def test_the_box_counts_in_the_upright_image(tmp_path):
    exif = Image.Exif()
    exif[ExifTags.Base.Orientation] = 6
    Image.fromarray(NOISE).save(tmp_path / "turned.png", exif=exif)
    seen = look(tmp_path / "turned.png", Hints(box=(0, 0, 60, 60)), SMALL).pictures[0]
    assert np.array_equal(seen, np.rot90(NOISE, -1)[:60, :60])


def test_several_images_answer_together(predictor):
    pictures = [NOISE[:64, :64], NOISE[:90, 30:120]]  # of two sizes
    one, other = (predictor.predict(picture, "use") for picture in pictures)
    both, turned = (predictor.predict(shown, "use") for shown in (pictures, pictures[::-1]))
    assert both.probabilities == pytest.approx(turned.probabilities, abs=1e-6)
    for kind, chance in both.probabilities.items():
        mean = (one.probabilities[kind] + other.probabilities[kind]) / 2
        assert chance == pytest.approx(mean, abs=0.1)
    assert both.probabilities != pytest.approx(one.probabilities, abs=1e-3)


def test_batches_answer_as_one_by_one(predictor):
    shown = [look(NOISE[: 40 + k, : 40 + k], Hints(), SMALL) for k in range(5)]
    together = predictor.answer(shown, "use", size_m=0.1)
    for one, answer in zip(shown, together, strict=True):
        alone = predictor.answer([one], "use", size_m=[0.1])[0]
        assert answer.probabilities == pytest.approx(alone.probabilities, abs=1e-5)
        assert answer.neighbours[0].name == alone.neighbours[0].name
        assert answer.size_m == (0.1,)


def test_depth_gives_the_size(predictor):
    depth_m = np.where(MASK, 0.5, 0.8)
    camera = Intrinsics((200.0, 200.0), (64.0, 48.0))
    told = predictor.predict(NOISE, "use", mask=MASK, depth=depth_m, intrinsics=camera)
    assert told.size_m == (pytest.approx(59 * 0.5 / 200, rel=0.01),)
    known = predictor.predict(NOISE, "use", mask=MASK, size_m=told.size_m)
    assert known.probabilities == told.probabilities
    with pytest.raises(InputError, match="needs --mask or --box"):
        predictor.predict(NOISE, "use", depth=depth_m, intrinsics=camera)


def test_points_and_meshes_have_a_size(predictor, tmp_path):
    can = trimesh.creation.cylinder(0.03, 0.12, sections=24)
    can.export(tmp_path / "can.stl")
    np.save(tmp_path / "can.npy", trimesh.sample.sample_surface(can, 2000, seed=1)[0])
    for name in ("can.stl", "can.npy"):
        answer = predictor.predict(tmp_path / name, "use")
        assert answer.size_m == pytest.approx((0.12, 0.06, 0.06), rel=0.05)
        assert any("surface around" in text for text in answer.warnings) == (name == "can.npy")


def test_noise_is_strange_and_the_answer_says_so(predictor):
    answer = predictor.predict(NOISE, "use")
    assert answer.strangeness > 1
    assert "nothing that was learned looks like this" in answer.warnings[-1]
    assert len(answer.neighbours) == 3


def test_threads_answer_as_one(predictor):
    pictures = [NOISE[k : k + 60, k : k + 60] for k in range(8)]
    alone = [predictor.predict(picture, "use").probabilities for picture in pictures]
    with ThreadPoolExecutor(4) as pool:
        told = list(pool.map(lambda one: predictor.predict(one, "use").probabilities, pictures))
    assert told == alone


@pytest.mark.parametrize(
    ("text", "size_m"),
    [("12cm", (0.12,)), ("12x5x3cm", (0.12, 0.05, 0.03)), ("3 x 5x12 mm", None), (".5m", (0.5,))],
)
def test_sizes_have_units(text, size_m):
    if size_m is None:
        with pytest.raises(InputError, match="must be a length or all three"):
            read_size(text)
    else:
        assert read_size(text) == pytest.approx(size_m)
