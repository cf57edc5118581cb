"""Objects are left out in all their shapes, and variants answer for their object."""

import numpy as np
import pandas as pd
import pytest
from learning import OBJECTS, SETTINGS, TASKS, VIEWS, features, samples

from grasptypes.predictors.generalisation import (
    GENERALISATION_SCHEMA,
    VariantInputs,
    constant_similarity,
    describe,
    inherit,
    summarize,
    trial_examples,
    try_trial,
)
from grasptypes.predictors.members import members_by_object
from grasptypes.predictors.scoring import METRIC_SCHEMA
from grasptypes.reports.generalisation_figure import draw_generalisation
from grasptypes.settings.predictors import VariantTrial

VARIANTS = {
    f"{name}_v{number:02d}": {encoding: array + 0.01 * number for encoding, array in shown.items()}
    for name, shown in features().items()
    for number in (1, 2)
}
KNOWN = VariantInputs(features(), VARIANTS, samples(), list(TASKS))


def test_no_shape_of_the_object_is_trained_on_and_only_itself_is_tested():
    names = np.repeat(["mug", "mug_v01", "pan", "pan_v01"], 3)
    learnt = np.tile([True, True, False], 4)
    members = members_by_object(names, 2, learnt)
    assert [(member.group, member.seed) for member in members] == [
        ("mug", 0), ("pan", 0), ("mug", 1), ("pan", 1),
    ]  # fmt: skip
    assert members[0].train.tolist() == [6, 7, 9, 10]
    assert members[0].test.tolist() == [0, 1, 2]
    assert members_by_object(names, 1)[0].train.tolist() == [6, 7, 8, 9, 10, 11]


def test_variants_have_the_labels_of_their_object_and_the_views_of_the_trial():
    known = inherit(samples(), ["mug", "mug_v01"]).set_index(["object", "task"])
    assert known.loc[("mug_v01", "use")].equals(known.loc[("mug", "use")])
    found = trial_examples(KNOWN, "task_vector", VariantTrial(shapes=3, views=5))
    views = found.index.groupby("object")["view"].nunique()
    assert views["mug"] == VIEWS
    assert views["mug_v02"] == 5
    assert len(views) == 3 * len(OBJECTS)


@pytest.fixture(scope="module")
def trials():
    tables = []
    for trial in (VariantTrial(shapes=1, views=10), VariantTrial(shapes=2, views=5)):
        metrics = try_trial(KNOWN, "task_vector", trial, SETTINGS, (2, 0))
        source = {"labels": "simulated", "model": "task_vector", "backbone": "b", "weights": "w"}
        table = metrics.assign(**source, finetune="none")[list(METRIC_SCHEMA.columns)]
        tables.append(table.assign(shapes=trial.shapes, views=trial.views))
    return pd.concat(tables)


def test_as_many_pictures_are_trained_on_whatever_the_shapes(trials):
    assert set(trials.n_train) == {10 * (len(OBJECTS) - 1) * len(TASKS)}
    assert set(trials.n_test) == {VIEWS * len(TASKS)}


def test_the_gain_is_that_over_one_shape_in_as_many_pictures(trials):
    best = constant_similarity(samples())
    constant = {("simulated", model): value for model, value in best.items()}
    table = GENERALISATION_SCHEMA.validate(summarize(trials, constant))
    one, two = table[table.shapes == 1].iloc[0], table[table.shapes == 2].iloc[0]
    assert np.isnan(one.sim_gain)
    assert two.sim_gain == pytest.approx(two.sim_mean - one.sim_mean, abs=2e-6)
    assert (table.n_objects == len(OBJECTS)).all()
    assert (table.constant_sim - best["task_vector"]).abs().max() < 1e-6
    assert f"task_vector {two.sim_gain:+.3f}" in describe(table)
    axes = draw_generalisation(table).axes[0]
    assert {"-", "--"} <= {line.get_linestyle() for line in axes.lines}
