"""A third task and an own object with a measured map, from nothing to Table I."""

import json

import numpy as np
import pandas as pd
import pytest
from own_things import NAMES, TASKS, TUBE, WARM_MM, add_own_things
from repository import Repository

MODELS = ["no_task", "task_vector", "task_in_image", "ignores_task"]
SESSIONS = 3


def test_a_third_task_and_an_own_object_are_planned(repository: Repository) -> None:
    add_own_things(repository)
    planned = repository.planned("reports/table1.csv", "reports/table1_published.csv")
    assert planned["synthesize_grasps"] == planned["map_contacts"] == 4 * 3
    assert planned["extract_features"] == 4
    assert planned["train_predictor"] == 2 * len(MODELS)


def test_published_labels_of_nothing_are_refused_in_one_line(repository: Repository) -> None:
    add_own_things(repository)
    repository.set_param("objects.names", [])
    output = repository.run("snakemake", "-n", check=False)
    assert "error: params.yaml: labels: 'published' has none of these objects" in output


def test_without_published_labels_nothing_of_them_is_planned(repository: Repository) -> None:
    add_own_things(repository, **{"objects.names": [], "labels": ["simulated"]})
    planned = repository.planned("all")
    assert planned["train_predictor"] == len(MODELS)
    assert planned["tabulate_simulated"] == planned["summarise_scores"] == 1
    for name in ("label_published", "tabulate_published", "compare_distribution"):
        assert planned[name] == 0, name
    # One object cannot be left out: nothing would be there to learn from.
    for name in ("leave_out_objects", "tabulate_unseen", "tabulate_objects"):
        assert planned[name] == 0, name
    repository.set_param("objects.names", ["mug"])
    assert repository.planned("all")["leave_out_objects"] == len(MODELS)


def test_a_mesh_with_a_measured_map_gets_samples_of_three_tasks(repository: Repository) -> None:
    add_own_things(repository, **{"objects.names": [], "labels": ["simulated"]})
    repository.snakemake("data/samples.csv")
    samples = pd.read_csv(repository.path / "data/samples.csv")
    assert sorted(samples.task) == sorted(TASKS)
    assert set(samples.object) == {TUBE}
    assert held_where_it_is_warm(repository)


def held_where_it_is_warm(repository: Repository) -> bool:
    """Whether the hands of the tube's measured map are at its warm half."""
    with np.load(repository.path / f"data/contact_maps/{TUBE}/use.npz") as contact_map:
        z_mm = 1000 * contact_map["centre_m"][:, 2]
    return bool(((z_mm > WARM_MM[0] - 30) & (z_mm < WARM_MM[1] + 30)).all())


@pytest.mark.slow
def test_four_objects_and_three_tasks_end_in_table1(repository: Repository) -> None:
    add_own_things(repository, **{"contact_maps.sessions": SESSIONS, "renders.views": 4})
    repository.snakemake("reports/table1.csv", "reports/table1_published.csv")
    data, reports = repository.path / "data", repository.path / "reports"

    grasps = pd.read_csv(data / "grasps.csv")
    assert (grasps.groupby(["Object", "Intent"]).size() == SESSIONS).all()
    samples = pd.read_csv(data / "samples.csv")
    everything = pd.MultiIndex.from_product([[*NAMES, TUBE], TASKS])
    assert set(zip(samples.object, samples.task, strict=True)) == set(everything)

    assert held_where_it_is_warm(repository)

    for name, tasks in (("table1", [*TASKS]), ("table1_published", ["use", "handoff"])):
        table = pd.read_csv(reports / f"{name}.csv")
        ours = table[table.n_folds > 0]
        assert ours.model.tolist() == MODELS
        assert ours[["sim_mean", "acc_mean", "prec_mean"]].notna().all(axis=None)
        labels = ours.labels.iloc[0]
        card = json.loads(
            (repository.path / f"models/{labels}/task_vector/predictor.json").read_text()
        )
        assert card["tasks"] == tasks
    published = pd.read_csv(data / "published_samples.csv")
    assert sorted(set(published.object)) == NAMES
