"""Demonstrations are split from those learnt from, and a wrong one misleads the model."""

import numpy as np
import pandas as pd
import pytest
from learning import OBJECTS, SETTINGS, features, folds, samples

from grasptypes.errors import InputError
from grasptypes.files import write_npz
from grasptypes.predictors.demonstrations import (
    DEMONSTRATION_SCHEMA,
    SPLITS,
    TASKS,
    Demonstrations,
    folds_of,
    markdown,
    read_features,
    shown_beside,
    summarize,
    try_demonstrations,
)
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.scoring import METRIC_SCHEMA
from grasptypes.predictors.variants import VARIANTS
from grasptypes.runs.demonstration_runs import demonstration_records
from grasptypes.settings.demonstrations import DemonstrationTable, Use, read_demonstrations

NAMES = [f"{name}_{number}" for number in range(3) for name in OBJECTS]
SHOWN = 8


def uses() -> DemonstrationTable:
    """As many actions as folds, each with three objects."""
    known = read_demonstrations()
    actions = dict(zip(OBJECTS, known.actions.values(), strict=False))
    use = Use(action="apple", part="flesh", ahead=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0))
    rows = {name: use.changed(action=name[:-2]) for name in NAMES}
    return known.changed(actions=actions, uses=rows)


def demonstrations() -> Demonstrations:
    """A direction for each task, with noise."""
    index = pd.DataFrame(
        [(name, task, view) for name in NAMES for task in TASKS for view in range(SHOWN)],
        columns=["object", "task", "view"],
    )
    noise = np.random.default_rng(1).normal(scale=0.1, size=(len(index), 6))
    signal = np.eye(6)[index["task"].map(TASKS.index)]
    return Demonstrations(index, (noise + signal).astype(np.float32))


def examples():
    return assemble(VARIANTS["no_task"], features(), samples(), folds(), list(TASKS))


@pytest.mark.parametrize("split", SPLITS)
def test_no_demonstration_of_a_test_is_learnt_from(split):
    index, table = demonstrations().index, uses()
    fold = folds_of(index, split, table, 4, seed=0)
    assert set(fold) == {0, 1, 2, 3}
    apart = {"views": index["view"], "objects": index["object"]}
    apart["actions"] = index["object"].map(lambda name: table.uses[name].action)
    assert (pd.Series(fold).groupby(apart[split]).nunique() == 1).all()


@pytest.mark.parametrize("wrong", [False, True])
def test_another_object_shows_the_task_in_the_fold_of_the_image(wrong):
    index = demonstrations().index
    index = index.assign(fold=folds_of(index, "views", uses(), 4, 0))
    shown = examples().index.assign(object=lambda table: table["object"] + "_0")
    rows = index.iloc[shown_beside(shown, index, wrong, np.random.default_rng(0))]
    assert (rows["object"].to_numpy() != shown["object"].to_numpy()).all()
    assert ((rows["task"].to_numpy() != shown["task"].to_numpy()) == wrong).all()
    assert (rows["fold"].to_numpy() == shown["fold"].to_numpy()).all()
    assert rows["object"].nunique() == len(NAMES)


def test_too_few_objects_to_show_others_are_an_error():
    index = demonstrations().index.assign(fold=0)
    alone = index[index["object"] == "mug_0"].reset_index(drop=True)
    with pytest.raises(InputError, match="no other object than mug_0 is demonstrated in fold 0"):
        shown_beside(alone, alone, False, np.random.default_rng(0))


def test_a_wrong_demonstration_misleads_and_none_leaves_the_task_open():
    found = try_demonstrations(examples(), demonstrations(), uses(), (SETTINGS, 0.3), seed=0)
    assert len(found) == len(SPLITS) * 3 * 4 * SETTINGS.seeds
    means = found.groupby(["split", "told"])["angular_similarity"].mean().unstack()
    assert (means["right"] > 0.9).all()
    assert (means["wrong"] < means["none"]).all()
    assert (means["none"] < means["right"] - 0.05).all()
    source = {"labels": "published", "backbone": "b", "weights": "w", "finetune": "none"}
    others = found[found["told"] == "none"].drop_duplicates(["group", "seed"]).assign(**source)
    others = others.assign(model="no_task")[list(METRIC_SCHEMA.columns)]
    table = summarize(found.assign(**source, model="demonstration"), others)
    DEMONSTRATION_SCHEMA.validate(table)
    assert table["model"].tolist() == ["no_task", *["demonstration"] * 9]
    records = demonstration_records(found.assign(**source, model="f"), {}, (1, 2), {"hand": "h"})
    assert [record.name for record in records] == [f"published f, new {name}" for name in SPLITS]
    assert {len(record.children) for record in records} == {4 * SETTINGS.seeds}
    for record, split in zip(records, SPLITS, strict=True):
        assert record.metrics["angular_similarity"] == pytest.approx(means["right"][split])
        assert record.metrics["wrong.angular_similarity"] == pytest.approx(means["wrong"][split])
    assert f"| actions | wrong | {table.sim_mean[8]:.3f} ± " in markdown(table)


def test_files_hold_the_same_number_of_images_of_each_task(tmp_path):
    array = np.arange(8.0, dtype=np.float32)[:, None]
    write_npz(tmp_path / "mug.npz", {"none": array})
    found = read_features([tmp_path / "mug.npz"])
    assert found.index["task"].tolist() == ["handoff", "use"] * 4
    assert found.features.ravel().tolist() == list(range(8))
    write_npz(tmp_path / "mug.npz", {"none": array[:7]})
    with pytest.raises(InputError, match="7 images of 2 tasks"):
        read_features([tmp_path / "mug.npz"])
