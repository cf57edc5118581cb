"""Results by grasp type and by object."""

import numpy as np
import pandas as pd
import pytest

from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.predictors.metrics import METRICS
from grasptypes.reports.breakdown import (
    KNOWN,
    LOGITS,
    OBJECT_SCHEMA,
    TYPE_SCHEMA,
    UNSEEN,
    by_left_out_object,
    by_object,
    by_type,
)
from grasptypes.reports.breakdown_figures import draw_objects, draw_types


def samples() -> pd.DataFrame:
    """A mug that is held in two ways, another one a task."""
    counts = pd.DataFrame([[3, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 2]], columns=list(COUNTS))
    return samples_from_counts(counts.assign(object="mug", task=["use", "handoff"]))


def predictions(tasks: list[str], named: list[list[int]]) -> pd.DataFrame:
    logits = np.where(np.array(named, dtype=bool), 20.0, -20.0).astype(np.float32)
    table = pd.DataFrame(logits, columns=list(LOGITS))
    return table.assign(object="mug", view=0, task=tasks, group="0", seed=0)


def test_types_are_counted_over_all_answers() -> None:
    answers = predictions(["use", "handoff"], [[1, 1, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0]])
    table = by_type(answers, samples()).set_index("grasp_type")
    assert table.loc["large_wrap", ["n_labelled", "n_chosen", "n_right"]].tolist() == [1, 2, 1]
    assert table.loc["large_wrap", ["precision", "recall", "accuracy"]].tolist() == [0.5, 1.0, 0.5]
    assert table.loc["precision", "recall"] == 0.0
    assert np.isnan(table.loc["precision", "precision"])
    assert np.isnan(table.loc["small_wrap", "recall"])


def test_answers_without_a_task_are_asked_for_the_types_of_all_tasks() -> None:
    table = by_object(predictions([""], [[1, 0, 0, 0, 0, 1]]), samples())
    three_to_two = 1 - 2 / np.pi * (np.pi / 4 - np.arctan(2 / 3))
    expected = [1.0, 1.0, 1.0, three_to_two]
    assert table[list(METRICS)].iloc[0].tolist() == pytest.approx(expected, abs=1e-6)
    half = by_object(predictions(["use"], [[1, 0, 0, 0, 0, 1]]), samples())
    assert half[list(METRICS)].iloc[0].tolist() == pytest.approx([0.5] * 4, abs=1e-6)


def test_figures_show_what_the_tables_hold() -> None:
    source = {"labels": "simulated", "model": "task_vector"}
    answers = predictions(["use"], [[1, 0, 0, 0, 0, 0]])
    types = by_type(answers, samples()).assign(**source)
    figure = draw_types(TYPE_SCHEMA.validate(types[list(TYPE_SCHEMA.columns)]))
    assert [text.get_text() for text in figure.axes[0].texts] == ["1.00"]

    groups = pd.DataFrame({"group": ["mug", "mug"], **{key: [0.25, 0.75] for key in METRICS}})
    parts = [by_object(answers, samples()).assign(objects=KNOWN)]
    parts.append(by_left_out_object(groups).assign(objects=UNSEEN))
    objects = pd.concat(parts, ignore_index=True).assign(**source)
    figure = draw_objects(OBJECT_SCHEMA.validate(objects[list(OBJECT_SCHEMA.columns)]))
    shown = [[text.get_text() for text in axes.texts] for axes in figure.axes[:2]]
    assert shown == [["1.00", "1.00"], ["0.50", "0.50"]]  # the object, and the mean
