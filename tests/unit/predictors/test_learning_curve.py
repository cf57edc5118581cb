"""Fewer images of each object, and the same test and steps."""

import numpy as np
from learning import OBJECTS, SETTINGS, TASKS, examples

from grasptypes.predictors.learning_curve import (
    CURVE_SCHEMA,
    TRIAL_SCHEMA,
    first_views,
    summarize,
    try_views,
)
from grasptypes.reports.learning_curve_figure import draw_learning_curve


def test_as_many_images_of_every_object_are_learnt_from():
    index = examples("task_vector").index
    rows = np.flatnonzero(index["fold"] != 0)
    kept = index.iloc[first_views(index, rows, 3)]
    assert (kept["fold"] != 0).all()
    assert (kept.groupby("object")["view"].nunique() == 3).all()
    assert len(kept) == 3 * len(OBJECTS) * len(TASKS)
    assert len(first_views(index, rows, 80)) == len(rows)


def test_more_images_help():
    settings = SETTINGS.changed(epochs=20, seeds=1)
    found = try_views(examples("task_in_image"), [1, 15], settings, ("key",))
    source = {"labels": "published", "model": "task_in_image"}
    used = {"backbone": "b", "weights": "w", "finetune": "none"}
    trials = TRIAL_SCHEMA.validate(found.assign(**source, **used)[[*TRIAL_SCHEMA.columns]])
    assert (trials.groupby("views")["n_train"].min() == [12, 180]).all()
    assert trials["n_test"].nunique() == 1
    table = CURVE_SCHEMA.validate(summarize(trials))
    assert table["views"].tolist() == [1, 15]
    assert table["sim_mean"][1] > table["sim_mean"][0]
    axes = draw_learning_curve(table, {"published": 0.8}).axes
    assert [len(each.get_xticks()) for each in axes] == [2, 2]
