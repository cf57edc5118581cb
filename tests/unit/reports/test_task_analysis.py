"""The paper's analysis of the labels."""

import numpy as np
import pandas as pd
import pytest

from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.reports.task_analysis import ANALYSIS_SCHEMA, analyse, share_changes
from grasptypes.reports.task_figures import draw_analysis, draw_changes

ROWS = [
    ("cup", "use", 20, 0, 0, 0, 0, 0),
    ("cup", "handoff", 0, 10, 0, 10, 0, 0),
    ("pan", "use", 5, 5, 0, 5, 5, 0),
    ("pan", "handoff", 5, 5, 0, 5, 5, 0),
]
SAMPLES = samples_from_counts(pd.DataFrame(ROWS, columns=["object", "task", *COUNTS]))


def test_types_tasks_and_noise_of_each_object():
    table = ANALYSIS_SCHEMA.validate(analyse(SAMPLES, "simulated")).set_index("object")
    assert table.loc["cup", ["types", "shared", "differing"]].tolist() == [1.5, 0, 3]
    assert table.loc["pan", ["types", "shared", "differing"]].tolist() == [4, 4, 0]
    assert table.loc["cup", "task_similarity"] == pytest.approx(0)
    assert table.loc["pan", "task_similarity"] == pytest.approx(1)
    # Dealt at random, the cup's tasks are alike; the pan's are less so than in truth.
    assert table.loc["cup", "chance_similarity"] > 0.5
    assert 0.5 < table.loc["pan", "chance_similarity"] < 1
    # One type in all sessions of use: drawing again changes nothing there.
    assert table.loc["cup", "noise_frequencies"] > table.loc["pan", "noise_frequencies"]
    assert table.loc["pan", "noise_sets"] > table.loc["pan", "noise_frequencies"]


def test_the_analysis_repeats():
    pd.testing.assert_frame_equal(analyse(SAMPLES, "a"), analyse(SAMPLES[::-1], "a"))


def test_changes_are_against_use_and_sum_to_zero():
    (title, change), *others = share_changes(SAMPLES).items()
    assert (title, others) == ("handoff - use", [])
    np.testing.assert_allclose(change.sum(axis=1), 0, atol=1e-12)
    assert change.loc["cup"].tolist() == [-1, 0.5, 0, 0.5, 0, 0]


def test_figures_have_panels_for_every_source():
    table = pd.concat([analyse(SAMPLES, labels) for labels in ("simulated", "published")])
    assert len(draw_analysis(table).axes) == 6
    heat_maps = draw_changes({"simulated": SAMPLES, "published": SAMPLES})
    shown = [text.get_text() for text in heat_maps.axes[0].texts]
    assert shown == ["-100", "+50", "+50"]
