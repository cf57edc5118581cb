"""A user's additions: a third task for known objects, and a mesh with a measured contact map."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import trimesh
from repository import Repository

MODELS = ["no_task", "task_vector", "task_in_image", "ignores_task", "e_mobilenet_v2"]
SESSIONS = 3
TASKS = {"use": 10, "handoff": -10, "wash": -20}
NAMES = ["banana", "mug", "water_bottle"]
TUBE = "tube"
RADIUS_MM, LENGTH_MM = 25.0, 220.0
# Where the tube is warm, from its middle along its axis.
WARM_MM = (20.0, 100.0)


def add_own_things(repository: Repository, **changes: object) -> None:
    """Four objects, one of them own, and three tasks, laid over the small configuration."""
    write_tube(repository.path / "meshes")
    own = {
        "file": "meshes/tube.stl",
        "unit": "mm",
        "mass_kg": 0.15,
        "parts": {"body": {"role": "grip_body"}},
        "contact_maps": {"use": "meshes/tube_use.ply"},
    }
    values = {
        "tasks": {task: {"colour_shift": shift} for task, shift in TASKS.items()},
        "objects.names": NAMES,
        "objects.own": {TUBE: own},
        **changes,
    }
    for key, value in values.items():
        repository.set_param(key, value)


def write_tube(folder: Path) -> None:
    """A mesh, and a scan of it as ContactDB publishes them: warm all around one half."""
    folder.mkdir()
    coarse = trimesh.creation.cylinder(RADIUS_MM, LENGTH_MM, sections=48)
    coarse.export(folder / "tube.stl")
    fine = trimesh.remesh.subdivide_to_size(coarse.vertices, coarse.faces, 4.0)
    scan = trimesh.Trimesh(*fine, process=False)
    low, high = WARM_MM
    warm = (scan.vertices[:, 2] > low) & (scan.vertices[:, 2] < high)
    red = np.where(warm, 250, 20)
    scan.visual.vertex_colors = np.column_stack([red, 0 * red, 0 * red]).astype(np.uint8)
    scan.export(folder / "tube_use.ply", vertex_normal=True)


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
    few = {"objects.names": [], "labels": ["simulated"], "contact_maps.sessions": 2}
    add_own_things(repository, **few)
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
