"""What spoke for a type is where hiding lowers its logit."""

import numpy as np
from tests.unit.settings import PARAMS

from grasptypes.predictors.explanation import explain, small
from grasptypes.predictors.prediction_pictures import draw_explanation

SETTINGS = PARAMS.predict.explanation


def red_and_blue(pictures):
    """Logits that say how much red the upper left and how much blue the lower right has."""
    rows = np.stack(pictures).astype(float) / 255
    red, blue = rows[:, :32, :32, 0], rows[:, 32:, 32:, 2]
    return np.stack([red.mean((1, 2)), -blue.mean((1, 2))], axis=1)


def test_what_matters_is_marked_where_it_is_for_and_against():
    picture = np.zeros((64, 64, 3), dtype=np.uint8)
    picture[8:24, 8:24, 0] = 255
    picture[40:56, 40:56, 2] = 255
    heat = explain(picture, red_and_blue, SETTINGS)
    assert heat.shape == (2, 64, 64)
    assert heat[0, 16, 16] > 10 * np.abs(heat[0, 40:, 40:]).max()
    assert heat[1, 48, 48] < 0
    figure = draw_explanation(picture, {"Red": heat[0], "Blue": heat[1]}, "a $title$")
    assert [axes.get_title() for axes in figure.axes][:3] == ["image", "Red", "Blue"]


def test_images_get_the_size_of_the_backbone():
    assert small(np.zeros((100, 100, 3), dtype=np.uint8), 64).shape == (64, 64, 3)
