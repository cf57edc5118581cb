"""Figures of the results: what is drawn."""

import numpy as np
import pandas as pd
import pytest

from grasptypes.predictors.scoring import SHORT
from grasptypes.reports.figures import CONSTANT_LABEL
from grasptypes.reports.results import PAPER, paper_figures
from grasptypes.reports.table_figure import draw_table
from grasptypes.reports.training_figures import draw_folds, draw_losses


def results(paper):
    """Two models of one label source, with the constant answers that stand for each."""
    rows = []
    for model in ("no_task", "task_vector", "constant_of_others", "constant_of_others_joint"):
        trained = not model.startswith("constant")
        row = {"model": model, "labels": "published", "n_folds": 5 if trained else 0}
        for short in SHORT.values():
            row[f"{short}_mean"], row[f"{short}_sd"] = 0.8, 0.01
        row |= {name: 0.7 if paper and trained else np.nan for name in paper_figures(model)}
        rows.append(row | {"ceiling_sim": 0.97, "ceiling_acc": 0.97})
    return pd.DataFrame(rows)


@pytest.mark.parametrize("paper", [True, False])
def test_bars_stand_beside_the_papers_or_below_the_constant_answer(paper):
    figure = draw_table(results(paper))
    named = {text.get_text() for text in figure.legends[0].get_texts()}
    assert named == {"here", "ceiling of the labels", "paper" if paper else CONSTANT_LABEL}
    names = [text.get_text() for text in figure.axes[0].get_xticklabels()]
    assert names == ["(a) no task", "(b) task vector"]  # the constant answers have no bars


def test_every_fold_and_seed_is_a_dot_beside_the_mean_and_the_paper():
    rows = [("0", 0, 0.5), ("1", 0, 0.7), ("0", 1, 0.6), ("1", 1, 0.8)]
    metrics = pd.DataFrame(rows, columns=["group", "seed", "angular_similarity"])
    for name in SHORT:
        metrics[name] = metrics["angular_similarity"]
    figure = draw_folds(metrics.assign(labels="simulated", model="no_task"))
    dots, mean, paper = figure.axes[0].collections
    assert sorted(dots.get_offsets()[:, 1]) == [0.5, 0.6, 0.7, 0.8]
    assert mean.get_segments()[0][0][1] == pytest.approx(0.65)
    assert paper.get_segments()[0][0][1] == PAPER["no_task"][0]


def test_losses_are_the_mean_of_folds_and_seeds():
    curves = pd.DataFrame(
        {
            "group": ["0", "0", "1", "1"],
            "epoch": [1, 2, 1, 2],
            "train_loss": [4.0, 2.0, 2.0, 1.0],
            "test_loss": np.nan,
        }
    )
    axes = draw_losses({("simulated", "no_task"): curves}).axes[0]
    assert [line.get_ydata().tolist() for line in axes.lines] == [[3.0, 1.5]]
