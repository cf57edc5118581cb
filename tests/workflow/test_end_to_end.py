"""The small configuration, from nothing to Table I, and what both tools say of it afterwards."""

import sqlite3

import pandas as pd
from repository import Repository, jobs

TASKS = 2
OBJECTS = 2


def test_every_session_has_one_grasp_and_every_failure_a_reason(complete: Repository) -> None:
    grasps = pd.read_csv(complete.path / "data/grasps.csv")
    assert len(grasps) == OBJECTS * TASKS * 4
    for _, group in grasps.groupby(["Object", "Intent"]):
        assert sorted(group.Session) == [1, 2, 3, 4]
    invalid = grasps.GraspType == "Invalid"
    assert not (grasps[invalid].reason == "valid").any()
    assert (grasps[~invalid].reason == "valid").all()
    assert not grasps.isna().any().any()
    attempts = [
        pd.read_parquet(path) for path in (complete.path / "data/attempts").rglob("*.parquet")
    ]
    tried = pd.concat(attempts)
    assert (tried.valid == (tried.reason == "")).all()


def test_table1_has_the_four_models_beside_the_paper(complete: Repository) -> None:
    table = pd.read_csv(complete.path / "reports/table1.csv")
    models = ["no_task", "task_vector", "task_in_image", "ignores_task"]
    assert set(models) <= set(table.model)
    ours = table[table.model.isin(models)]
    for name in ("sim_mean", "acc_mean", "prec_mean"):
        assert ours[name].between(0, 1).all()
    assert dict(zip(ours.model, ours.paper_sim, strict=True))["task_in_image"] == 0.92
    assert ours.weights.nunique() == 1


def test_both_tools_have_nothing_to_do(complete: Repository) -> None:
    assert complete.snakemake_is_clean("all")
    assert complete.dvc_is_clean()
    assert jobs(complete.dvc("repro")) == {}


def test_every_fold_is_a_run_below_its_parent(complete: Repository) -> None:
    with sqlite3.connect(complete.path / "mlflow.db") as store:
        runs = store.execute("select count(*) from runs where status = 'FINISHED'").fetchone()[0]
        total = store.execute("select count(*) from runs").fetchone()[0]
        children = store.execute(
            "select count(*) from tags where key = 'mlflow.parentRunId'"
        ).fetchone()[0]
    parents = 4 * 2  # models and label sources
    assert (runs, total, children) == (3 * parents, 3 * parents, 2 * parents)
