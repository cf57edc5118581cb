"""Figures are drawn and hold the same bytes each time."""

import numpy as np
import pandas as pd

from grasptypes.labels.grasp_type import TYPES
from grasptypes.labels.label_pictures import draw_confusion, draw_distribution, save_figure
from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.reports.distribution import compare_distributions


def test_confusion_shows_every_count(tmp_path):
    counts = np.arange(36).reshape(6, 6)
    figure = draw_confusion(counts, TYPES, "title")
    assert {text.get_text() for text in figure.axes[0].texts} == {str(n) for n in range(36)}
    for name in ("a.png", "b.png"):
        save_figure(draw_confusion(counts, TYPES, "title"), tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_distribution_totals():
    rows = [["mug", "use", 1, 2, 3, 4, 5, 6], ["mug", "handoff", 0, 0, 0, 1, 0, 0]]
    counts = pd.DataFrame(rows, columns=["object", "task", *COUNTS])
    table = compare_distributions(samples_from_counts(counts), counts)
    figure = draw_distribution(table.iloc[:-1], TYPES, "title")
    labels = {text.get_text() for text in figure.axes[1].texts}
    assert labels == {"1", "2", "3", "5", "6"}
