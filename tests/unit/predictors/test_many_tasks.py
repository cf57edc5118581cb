"""Models are told one of many tasks: by a vector, a colour, a description, or a demonstration."""

import numpy as np
import pandas as pd
import pytest
from learning import OBJECTS, SETTINGS, VIEWS
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.predictors.demonstrations import Demonstrations
from grasptypes.predictors.folds import split
from grasptypes.predictors.many_task_tables import (
    TABLE_SCHEMA,
    TRIAL_SCHEMA,
    label_similarity,
    markdown,
    summarize,
)
from grasptypes.predictors.many_tasks import ManyTasks, try_model
from grasptypes.predictors.task_inputs import affordance_vectors
from grasptypes.predictors.told import MODELS, UNSEEN_TASK_MODELS, corner_shifts
from grasptypes.reports.many_tasks_figure import draw_many_tasks
from grasptypes.runs.many_task_runs import many_task_records
from grasptypes.settings.many_tasks import ManyTaskSettings
from grasptypes.settings.tasks import read_tasks

TASKS = ("use", "handoff", "wash", "pour")
STUDY = PARAMS.many_tasks.changed(tasks=TASKS, numbers=(2, 4), views=VIEWS, embedding=4)


def samples() -> pd.DataFrame:
    """Two types for every pair, one of them the task's; no object pours but the mug and the pan."""
    rows = []
    for i, name in enumerate(OBJECTS):
        for j, task in enumerate(TASKS):
            if task == "pour" and name not in ("mug", "pan"):
                continue
            counts = np.zeros(6, dtype=int)
            counts[[i % 2, 2 + j]] = 5
            rows.append({"object": name, "task": task, **dict(zip(COUNTS, counts, strict=True))})
    return samples_from_counts(pd.DataFrame(rows))


def problem() -> ManyTasks:
    rng = np.random.default_rng(0)
    inputs = {}
    for i, name in enumerate(OBJECTS):
        base = rng.normal(scale=0.1, size=(VIEWS, 24)) + 2 * np.eye(24)[i]
        shown = {task: base + 2 * np.eye(24)[10 + j] for j, task in enumerate(TASKS)}
        inputs[name] = {key: x.astype(np.float32) for key, x in {"none": base, **shown}.items()}
    index = pd.DataFrame(
        [(name, task, view) for name in OBJECTS for task in TASKS for view in range(8)],
        columns=["object", "task", "view"],
    )
    noise = rng.normal(scale=0.1, size=(len(index), 6))
    shown = (noise + 2 * np.eye(6)[index["task"].map(TASKS.index)]).astype(np.float32)
    folds = split(dict.fromkeys(OBJECTS, VIEWS), 4, seed=0)
    demonstrations = Demonstrations(index, shown)
    training = SETTINGS.changed(seeds=2, epochs=60)
    return ManyTasks(samples(), folds, inputs, demonstrations, STUDY, training, 0.1, seed=0)


@pytest.fixture(scope="module")
def trials() -> pd.DataFrame:
    tables = [try_model(problem(), model) for model in MODELS]
    return TRIAL_SCHEMA.validate(pd.concat(tables, ignore_index=True)[[*TRIAL_SCHEMA.columns]])


def test_whoever_is_told_the_task_knows_its_types(trials):
    known = trials[trials["split"] == "views"].groupby(["model", "tasks"])["angular_similarity"]
    means = known.mean().unstack()
    assert (means.drop("no_task") > 0.9).all(axis=None)
    assert (means.loc["no_task"] < 0.85).all()


def test_a_task_is_left_out_and_only_those_are_tested_that_can_be_told_it(trials):
    unseen = trials[trials["split"] == "tasks"]
    assert set(unseen["model"]) == set(UNSEEN_TASK_MODELS)
    assert (unseen["group"] == unseen["task"]).all()
    assert set(unseen["task"]) == set(TASKS)
    # A fold of four has 5 of 20 images: of four objects, or of the two that pour.
    one = unseen[(unseen["model"] == "no_task") & (unseen["seed"] == 0)]
    tested = one.groupby("task")["n_test"].sum()
    assert tested["pour"] == 10
    assert tested["wash"] == 20


def test_the_table_averages_over_pairs_and_counts_them(trials):
    table = TABLE_SCHEMA.validate(summarize(trials, samples(), TASKS))
    rows = table.set_index(["split", "model", "tasks", "evaluated"]).sort_index()
    assert rows.loc[("views", "film", 4, "all"), "n_pairs"] == 14
    assert rows.loc[("views", "film", 4, "common"), "n_pairs"] == 8
    own = trials[
        (trials["model"] == "film") & (trials["tasks"] == 4) & (trials["split"] == "views")
    ]
    mean = np.average(own["angular_similarity"], weights=own["n_test"])
    assert rows.loc[("views", "film", 4, "all"), "sim_mean"] == pytest.approx(mean, abs=1e-3)
    assert rows.loc[("views", "film", 4, "all"), "n_runs"] == 4 * 2
    assert rows.loc[("views", "film", 2, "all"), "gain"] > 0.1
    # Two types of equal weight; the answer to an object has one of them in common with each task.
    assert rows.loc[("views", "object_known", 2, "all"), "sim_mean"] == pytest.approx(
        2 / 3, abs=0.01
    )
    assert rows.loc[("tasks", "object_known", 4, "pour"), "sim_mean"] < 0.6
    assert label_similarity(samples()) == pytest.approx(1 / 3)
    text = markdown(table)
    assert (
        f"| FiLM, embedding of the task | {rows.loc[('views', 'film', 2, 'all')].sim_mean:.3f}"
        in text
    )
    panels = draw_many_tasks(table).axes
    assert [len(axes.get_xticks()) for axes in panels] == [2, 2, 5]


def test_a_run_for_every_number_of_tasks_and_fold(trials):
    own = trials[trials["model"] == "no_task"]
    records = many_task_records(own, {"epochs": 3}, (1, 2), {"hand": "h"})
    names = ["2 tasks", "4 tasks", "each of 4 tasks left out"]
    assert [record.name for record in records] == [f"simulated no_task, {name}" for name in names]
    assert [len(record.children) for record in records] == [8, 8, 8]
    first = own[(own["tasks"] == 2) & (own["split"] == "views")]
    assert records[0].metrics["angular_similarity"] == pytest.approx(
        first["angular_similarity"].mean()
    )


def test_the_papers_colours_are_the_first_and_all_have_the_same_size():
    shifts = corner_shifts(PARAMS.many_tasks.tasks, 10)
    assert list(shifts.values())[:2] == [(10, 10, 10), (-10, -10, -10)]
    assert len(set(shifts.values())) == len(shifts)
    assert {abs(part) for shift in shifts.values() for part in shift} == {10}


def test_tasks_that_need_the_same_have_the_same_description():
    cut, strike = (read_tasks()[name] for name in ("cut", "strike"))
    vectors = affordance_vectors([cut, cut, strike])
    assert vectors.min() >= 0
    assert vectors.max() <= 1
    assert (vectors[0] == vectors[1]).all()
    assert (vectors[0] != vectors[2]).sum() > 3


def test_features_of_a_colour_that_are_missing_are_named():
    whole = problem()
    lacking = {name: {"none": shown["none"]} for name, shown in whole.inputs.items()}
    with pytest.raises(InputError, match=r"many_tasks/features/apple.npz: handoff: is missing"):
        ManyTasks(samples(), whole.folds, lacking, None, STUDY, SETTINGS, 0.1, 0).examples(
            "task_in_image", 2
        )


def test_more_numbers_than_tasks_are_an_error():
    values = PARAMS.many_tasks.model_dump() | {"numbers": [2, 8], "tasks": list(TASKS)}
    with pytest.raises(InputError, match="there are only 4 tasks"):
        ManyTaskSettings.check(values)
    with pytest.raises(InputError, match="'juggle' is not described"):
        ManyTaskSettings.check(values | {"tasks": ["use", "handoff", "juggle"]})
