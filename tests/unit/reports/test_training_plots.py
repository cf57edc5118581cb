"""Figures of folds, seeds and losses."""

import pandas as pd
import pytest

from grasptypes.predictors.scoring import SHORT
from grasptypes.reports.results import PAPER
from grasptypes.reports.training_plots import draw_folds, draw_losses


def test_every_fold_and_seed_is_a_dot_beside_the_mean_and_the_paper() -> None:
    rows = [("0", 0, 0.5), ("1", 0, 0.7), ("0", 1, 0.6), ("1", 1, 0.8)]
    metrics = pd.DataFrame(rows, columns=["group", "seed", "angular_similarity"])
    for name in SHORT:
        metrics[name] = metrics["angular_similarity"]
    figure = draw_folds(metrics.assign(labels="simulated", model="no_task"))
    dots, mean, paper = figure.axes[0].collections
    assert sorted(dots.get_offsets()[:, 1]) == [0.5, 0.6, 0.7, 0.8]
    assert mean.get_segments()[0][0][1] == pytest.approx(0.65)
    assert paper.get_segments()[0][0][1] == PAPER["no_task"][0]


def test_losses_are_the_mean_of_folds_and_seeds() -> None:
    curves = pd.DataFrame(
        {
            "group": ["0", "0", "1", "1"],
            "seed": 0,
            "epoch": [1, 2, 1, 2],
            "train_loss": [4.0, 2.0, 2.0, 1.0],
            "test_loss": None,
        }
    )
    curves["test_loss"] = curves["test_loss"].astype(float)
    axes = draw_losses({("simulated", "no_task"): curves}).axes[0]
    assert [line.get_ydata().tolist() for line in axes.lines] == [[3.0, 1.5]]
