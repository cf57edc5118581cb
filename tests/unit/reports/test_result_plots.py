"""Figures of the result tables: what is drawn, and the same bytes each time."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes

from grasptypes.reports.result_plots import CEILING, CONSTANT, PAPER, plot_table

MODELS = ["no_task", "task_vector"]


def results(paper):
    """Two models of one label source, with the constant answers that stand for each."""
    measures = {"sim": 0.8, "acc": 0.9, "prec": 0.95}
    rows = []
    for number, model in enumerate([*MODELS, "constant_of_others", "constant_of_others_joint"]):
        row = {"model": model, "labels": "published", "n_folds": 5 if model in MODELS else 0}
        for short, value in measures.items():
            row[f"{short}_mean"], row[f"{short}_sd"] = value - number / 20, 0.01
            row[f"paper_{short}"] = 0.7 if paper and model in MODELS else np.nan
            if short != "prec":
                row[f"ceiling_{short}"] = 0.97
        rows.append(row)
    return pd.DataFrame(rows)


@pytest.fixture
def drawn(monkeypatch):
    """What was drawn to any axes: colours of bars, and of levels above them."""
    found = {"bars": [], "levels": []}
    bar, hlines = Axes.bar, Axes.hlines

    def note_bar(self, *args, **how):
        found["bars"].append(how["color"])
        return bar(self, *args, **how)

    def note_hlines(self, *args, **how):
        found["levels"].append(how["colors"])
        return hlines(self, *args, **how)

    monkeypatch.setattr(Axes, "bar", note_bar)
    monkeypatch.setattr(Axes, "hlines", note_hlines)
    return found


def test_bars_stand_beside_the_papers_and_below_the_ceiling(drawn, tmp_path):
    plot_table(results(paper=True), tmp_path / "a.png")
    assert drawn["bars"].count(PAPER) == 3
    assert drawn["levels"] == [CEILING, CEILING]  # there is no ceiling of the precision
    plot_table(results(paper=True), tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_without_the_paper_the_constant_answer_of_the_others_is_drawn(drawn, tmp_path):
    plot_table(results(paper=False), tmp_path / "a.png")
    assert PAPER not in drawn["bars"]
    assert drawn["levels"].count(CONSTANT) == 3
