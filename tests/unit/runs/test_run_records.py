"""Runs from files: keys by content, one child a fold and seed."""

from dataclasses import replace

import pandas as pd
import pytest

from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.scoring import CURVE_SCHEMA, METRIC_SCHEMA
from grasptypes.runs.run_records import Finished, flatten, run_record, serving_requirements
from grasptypes.tables import write_table

PARAMS = {"seeds": 2, "finetuning": {"epochs": 3}}


@pytest.fixture
def finished(tmp_path):
    rows = [
        {"labels": "published", "model": "no_task", "group": str(g), "seed": s, "n_train": 8,
         "n_test": 2, **dict.fromkeys(METRICS, 0.5 + 0.1 * g), "backbone": "b", "weights": "w",
         "finetune": "none"}
        for s in range(2) for g in range(2)
    ]  # fmt: skip
    curves = [
        {"group": str(g), "seed": s, "epoch": e, "train_loss": 3.0 - e, "test_loss": 4.0 - e + g}
        for s in range(2) for g in range(2) for e in (1, 2)
    ]  # fmt: skip
    names = ("m.csv", "c.csv", "p.safetensors", "p.json")
    files = Finished(*(tmp_path / name for name in names), PARAMS)
    write_table(pd.DataFrame(rows), files.metrics, METRIC_SCHEMA)
    write_table(pd.DataFrame(curves), files.curves, CURVE_SCHEMA)
    files.card.write_text("{}")
    return files


def test_parent_holds_mean_and_spread_and_children_their_own(finished):
    record = run_record(finished, {"commit": "abc"})
    assert record.metrics["angular_similarity"] == pytest.approx(0.55)
    assert record.metrics["angular_similarity_sd"] == pytest.approx(0.0577, abs=1e-4)
    assert len(record.children) == 4
    child = record.children[1]
    assert (child.params["fold"], child.metrics["angular_similarity"]) == ("1", 0.6)
    assert child.curves["test_loss"] == [4.0, 3.0]
    assert child.params["finetuning.epochs"] == "3"
    assert child.tags == {"commit": "abc"}


def test_keys_are_made_from_content_alone(finished):
    record = run_record(finished, {"commit": "abc"})
    keys = [record.key, *(child.key for child in record.children)]
    assert len(set(keys)) == 5
    again = run_record(finished, {"commit": "def"})
    assert [again.key, *(child.key for child in again.children)] == keys
    assert run_record(replace(finished, settings=PARAMS | {"seeds": 3}), {}).key != record.key
    finished.metrics.write_text(finished.metrics.read_text().replace("0.6", "0.7"))
    assert run_record(finished, {}).key != record.key


def test_nested_settings_are_flattened():
    assert flatten({"a": {"b": [1, 2]}, "c": None}) == {"a.b": "[1, 2]", "c": "None"}


def test_served_packages_are_pinned():
    assert all("==" in line for line in serving_requirements())
