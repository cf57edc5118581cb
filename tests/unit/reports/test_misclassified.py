"""Which images are shown as misclassified, and in which order."""

import io
import zipfile
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.reports.breakdown import LOGITS
from grasptypes.reports.misclassified import draw_misclassified, misclassified

# The mug is held as a large wrap and precisely, the cup as a large wrap.
COUNTED = pd.DataFrame([[3, 0, 0, 0, 0, 1], [2, 0, 0, 0, 0, 0]], columns=list(COUNTS))
SAMPLES = samples_from_counts(COUNTED.assign(object=["mug", "cup"], task="use"))
RIGHT, LACKING, SURE, NOTHING = (
    [20, -20, -20, -20, -20, 20],
    [20, -20, -20, -20, -20, -1],
    [-20, 20, -20, -20, -20, -20],
    [-1, -20, -20, -20, -20, -1],
)


def predictions(
    logits: list[list[int]], names: list[str], views: list[int], seeds: list[int]
) -> pd.DataFrame:
    table = pd.DataFrame(np.array(logits, dtype=np.float32), columns=list(LOGITS))
    return table.assign(object=names, view=views, task="use", group="0", seed=seeds)


def test_every_image_is_shown_once_with_the_worst_answer_about_it() -> None:
    answers = predictions(
        [LACKING, SURE, RIGHT, NOTHING, SURE],
        ["mug", "mug", "mug", "mug", "cup"],
        [0, 0, 1, 2, 0],
        [0, 1, 0, 0, 0],
    )
    table = misclassified(answers, SAMPLES)
    # Both worst images come first; the mug's other image is less wrong.
    assert list(zip(table["object"], table["view"], strict=True)) == [
        ("cup", 0),
        ("mug", 0),
        ("mug", 2),
    ]
    assert table["predicted"].tolist() == ["medium wrap", "medium wrap", "nothing"]
    assert table["labelled"].tolist()[:2] == ["large wrap", "large wrap, precision"]
    assert table["similarity"].is_monotonic_increasing
    assert table["similarity"][2] == pytest.approx(1)


def test_the_figure_shows_those_images_and_no_others(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "mug.zip", "w") as archive:
        for view in range(2):
            picture = io.BytesIO()
            Image.new("RGB", (4, 4), (50 * view,) * 3).save(picture, "PNG")
            archive.writestr(f"{view:03d}.png", picture.getvalue())
    answers = predictions([RIGHT, LACKING], ["mug", "mug"], [0, 1], [0, 0])
    figure = draw_misclassified("model", answers, SAMPLES, {"mug": tmp_path / "mug.zip"})
    (shown,) = [image for axes in figure.axes for image in axes.images]
    assert (shown.get_array() == 50).all()
    assert shown.axes.get_title(loc="left").splitlines()[1:] == [
        "predicted: large wrap",
        "true: large wrap, precision",
    ]
    assert "1 of 2 images" in figure.get_suptitle()
