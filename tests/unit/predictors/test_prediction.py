"""From a trained predictor on disk to an answer, by library and by command line."""

import json

import numpy as np
import pytest
import torch
import trimesh
from learning import small_checkout
from PIL import Image
from scipy.special import softmax

from grasptypes.__main__ import main
from grasptypes.errors import InputError
from grasptypes.labels.samples import TYPES
from grasptypes.predictors import prediction
from grasptypes.predictors.answers import Answer, spelled
from grasptypes.predictors.prediction import predictor_paths
from grasptypes.predictors.prediction_pictures import draw_answers, montage
from grasptypes.predictors.predictor_files import ModelCard, load_predictor
from grasptypes.predictors.weights import WEIGHTS_VARIABLE, weights_file

PICTURE = np.random.default_rng(1).integers(0, 256, (64, 64, 3), dtype=np.uint8)


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A folder with parameters and two models of random weights, for three tasks."""
    root = tmp_path_factory.mktemp("checkout")
    small_checkout(root, {"renders": {"size_px": 96}, "predict": {"views": 3}})
    return root


@pytest.fixture
def predict(checkout, monkeypatch, capsys, tmp_path):
    """The command in that folder: what it prints on both channels, and its exit status."""
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(checkout / "random.pth"))
    monkeypatch.chdir(tmp_path)
    Image.fromarray(PICTURE).save(tmp_path / "photo.png")

    def run(*arguments):
        status = 0
        try:
            main(["predict", "--folder", str(checkout), *map(str, arguments)])
        except SystemExit as end:
            status = 1 if isinstance(end.code, str) else end.code
            if isinstance(end.code, str):
                return "", end.code, status
        shown = capsys.readouterr()
        return shown.out, shown.err, status

    return run


def test_the_command_says_what_the_predictor_says(predict, checkout):
    out, _, status = predict("photo.png", "--task", "wash", "--json")
    said = json.loads(out)
    assert status == 0
    assert (said["model"], said["task"]) == ("task_vector", "wash")
    folder = checkout / "models/simulated/task_vector"
    weights = weights_file("mobilenet_v2", "test", checkout / "random.pth")
    predictor = load_predictor(folder / "predictor.safetensors", folder / "predictor.json", weights)
    logits = predictor.logits(PICTURE[None], "wash")[0]
    (answer,) = said["answers"]
    shares = {each["type"]: each["share"] for each in answer["types"]}
    expected = dict(zip(map(spelled, TYPES), softmax(logits, axis=-1), strict=True))
    assert shares == pytest.approx(expected, abs=1e-6)
    chosen = {spelled(name) for name, value in zip(TYPES, logits, strict=True) if value > 0}
    assert {each["type"] for each in answer["types"] if each["chosen"]} == chosen
    chances = [each["probability"] for each in answer["types"]]
    assert chances == sorted(chances, reverse=True)
    worded, told, _ = predict("photo.png", "--task", "rinse the cup", "--json")
    assert (json.loads(worded), told) == (said, "task: wash\n")
    other = json.loads(predict("photo.png", "--task", "use", "--json")[0])
    assert other["answers"] != said["answers"]


def test_a_folder_has_a_row_a_picture_and_a_drawing(predict, tmp_path):
    folder = tmp_path / "photos"
    folder.mkdir()
    for name in ("b.png", "a.jpg"):
        Image.fromarray(PICTURE).save(folder / name)
    drawing = tmp_path / "drawn.png"
    out, _, _ = predict(folder, "--model", "a", "--picture", drawing)
    rows = out.splitlines()
    assert "no_task" in rows[0]
    assert "whatever the task" in rows[0]
    assert [row.split()[0] for row in rows[-2:]] == ["a.jpg", "b.png"]
    with Image.open(drawing) as picture:
        assert picture.width > 800


def test_a_mesh_is_seen_from_several_sides(predict, tmp_path):
    trimesh.creation.box((0.06, 0.08, 0.2)).export(tmp_path / "box.stl")
    out, _, _ = predict("box.stl", "--task", "use", "--json")
    (answer,) = json.loads(out)["answers"]
    assert answer["name"] == "box.stl, from 3 views"
    assert sum(each["share"] for each in answer["types"]) == pytest.approx(1, abs=1e-5)
    assert answer["size_m"] == pytest.approx([0.2, 0.08, 0.06])
    (tmp_path / "other.stl").write_bytes((tmp_path / "box.stl").read_bytes())
    again = predict("other.stl", "--task", "use", "--json")[0]
    assert again.replace("other.stl", "box.stl") == out  # whatever its name
    assert "unit: cm or mm" in predict(_huge(tmp_path), "--task", "use")[1]


def _huge(folder):
    trimesh.creation.box((6, 8, 20)).export(folder / "huge.stl")
    return "huge.stl"


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("--task", "fly"), "error: --task: fly: names no known task; nearest: use,"),
        ((), "error: --task: is needed; allowed: use, handoff, wash"),
    ],
)
def test_what_a_model_cannot_answer_is_one_line(predict, arguments, expected):
    out, err, status = predict("photo.png", *arguments)
    assert (out, status) == ("", 1)
    assert expected in err


def test_bad_pictures_of_a_folder_are_skipped_with_a_reason(predict, tmp_path):
    """Bad in the header or in the pixels: the rest is answered, drawn or not."""
    whole = (tmp_path / "photo.png").read_bytes()
    (tmp_path / "cut.png").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "zero.png").touch()
    (tmp_path / "note.txt").write_text("a note")
    Image.new("RGBA", (64, 64)).save(tmp_path / "clear.png")
    skipped = [
        "skipped clear.png: has transparent pixels: name the colour behind them",
        "skipped cut.png: cannot be read as an image: image file is truncated",
        "skipped note.txt: not an image (PNG",
        "skipped zero.png: not an image",
    ]
    asked = (tmp_path, "--model", "a")
    alone = predict("photo.png", "--model", "a", "--json")[0]
    drawn = tmp_path / "new" / "drawn.png"
    for more in ((), ("--picture", drawn)):
        out, err, status = predict(*asked, "--json", *more)
        assert (out, status) == (alone, 0)
        listed = err.splitlines()[: len(skipped)]
        assert all(map(str.startswith, listed, skipped)), err
    assert drawn.exists()
    assert predict(*asked, "--background", "white")[1].count("skipped") == 4  # `new` is one


def test_a_folder_of_damaged_pictures_is_rejected(predict, tmp_path):
    whole = (tmp_path / "photo.png").read_bytes()
    for name in ("photo.png", "zero.png"):
        (tmp_path / name).write_bytes(whole[: len(whole) // 2])
    drawn = tmp_path / "new" / "drawn.png"
    out, err, status = predict(tmp_path, "--model", "a", "--picture", drawn)
    assert (out, status) == ("", 1)
    reason = "cannot be read as an image"
    assert err.startswith(f"error: {tmp_path}: contains no usable image; photo.png: {reason}")
    assert not drawn.parent.exists()


def test_a_bad_picture_is_told_before_the_model_is_loaded(predict, tmp_path, monkeypatch):
    monkeypatch.setattr(prediction.Predictor, "load", None)
    (tmp_path / "photo.png").write_bytes((tmp_path / "photo.png").read_bytes()[:900])
    for place in ("photo.png", tmp_path):
        assert "cannot be read" in predict(place, "--model", "a")[1]


def test_other_weights_are_rejected_but_not_another_name(predict, checkout, monkeypatch, tmp_path):
    said = predict("photo.png", "--task", "use")
    (tmp_path / "renamed.pth").write_bytes((checkout / "random.pth").read_bytes())
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(tmp_path / "renamed.pth"))
    assert predict("photo.png", "--task", "use") == said
    state = torch.load(checkout / "random.pth")
    state["classifier.1.bias"] += 1
    torch.save(state, tmp_path / "other.pth")
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(tmp_path / "other.pth"))
    _, err, status = predict("photo.png", "--task", "use")
    assert status == 1
    assert "trained on mobilenet_v2, random.pth" in err
    assert f"set {WEIGHTS_VARIABLE} to that file" in err


def test_models_are_found_by_row_or_name(checkout):
    assert predictor_paths(checkout, "simulated", "b") == predictor_paths(
        checkout, "simulated", "task_vector"
    )
    with pytest.raises(InputError, match="is not trained yet"):
        predictor_paths(checkout, "published", "b")


def test_names_are_no_mathematics_and_have_room(checkout):
    card = ModelCard.read(checkout / "models/simulated/task_vector/predictor.json")
    even = np.full(len(TYPES), 1 / len(TYPES))
    names = ["a $\\cup$ of $5_$.png", "x" * 100 + ".png"]
    answers = [Answer.of(name, TYPES, even, even) for name in names]
    figure = draw_answers([PICTURE, PICTURE], answers, card, "use of $_$")
    figure.canvas.draw()
    first, _, _, second, _, _ = (axes.get_title() for axes in figure.axes)
    assert first == names[0]
    assert len(second) == 40
    assert second.startswith("xxx")
    assert second.endswith("xxx.png")


def test_names_that_are_no_text_are_drawn_and_printed(predict, tmp_path):
    name = "cup\udcff\x1b[31m.png"
    (tmp_path / "cups").mkdir()
    (tmp_path / "photo.png").rename(tmp_path / "cups" / name)
    asked = ("cups", "--task", "use", "--picture", "drawn.png")
    out, _, status = predict(*asked)
    assert status == 0
    assert "cup??[31m.png" in out.encode().decode()
    assert predict(*asked) == (out, "", 0)


def test_montage_fills_its_last_row():
    assert montage(np.zeros((5, 4, 4, 3), np.uint8), 4).shape == (8, 12, 3)
