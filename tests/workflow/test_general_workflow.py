"""The predictor for unseen objects, from kinds to Table III and the files of the package."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest
from repository import ROOT, Repository

from grasptypes.predictors.general_predictor import load_general
from grasptypes.predictors.general_protocol import KIND_TASKS, KINDS, OBJECTS, ROWS

TARGETS = {
    "table": "reports/table3.csv",
    "trials": "reports/general_trials.csv",
    "limits": "reports/general_limits.csv",
    "runs": "reports/general_runs.json",
    "card": "data/general/trained/general.json",
}


@pytest.mark.slow
def test_table_3_and_the_trained_head_come_from_kinds_and_objects(tmp_path: Path) -> None:
    repository = Repository.create(tmp_path / "repository", ROOT / "tests/small_general.yaml")
    repository.snakemake(*TARGETS.values())
    files = {name: repository.path / path for name, path in TARGETS.items()}
    table = pd.read_csv(files["table"])
    assert {KINDS, KIND_TASKS, OBJECTS} <= set(table["shown"])
    assert set(table["model"]) == set(ROWS)
    assert {"kinds", "backbone"} <= set(pd.read_csv(files["trials"])["setting"])
    assert len(pd.read_csv(files["limits"])) == 2 + table["labels"].nunique() - 1
    assert json.loads(files["runs"].read_text())
    assert load_general(files["card"].parent).card.shapes == 4 + 3
    assert "Nothing to be done" in repository.snakemake(*TARGETS.values())
