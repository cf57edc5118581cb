"""Tables of results beside the paper and the ceilings."""

import numpy as np
import pandas as pd
import pytest

from grasptypes.learning_inputs import BackboneRecord
from grasptypes.results import (
    METRIC_SCHEMA,
    RESULT_SCHEMA,
    curve_table,
    markdown,
    tabulate,
    with_source,
)
from grasptypes.samples import COUNTS, samples_from_counts
from grasptypes.training import Member

BACKBONE = BackboneRecord("mobilenet_v2", "a.pth (0a1b2c3d)", "0a1b2c3d", 224)


def metrics(model, similarities):
    rows = [
        {"group": str(k % 2), "seed": k // 2, "n_train": 8, "n_test": 2, "angular_similarity": s,
         "multilabel_accuracy": 0.5, "multilabel_precision": 1.0}
        for k, s in enumerate(similarities)
    ]  # fmt: skip
    table = with_source(pd.DataFrame(rows), ("published", model), BACKBONE, "none")
    return METRIC_SCHEMA.validate(table)


@pytest.fixture
def table():
    counts = pd.DataFrame([[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0]], columns=list(COUNTS))
    samples = samples_from_counts(counts.assign(object="mug", task=["use", "handoff"]))
    rows = [metrics("task_vector", [0.9, 0.9, 0.9, 0.9]), metrics("no_task", [0.4, 0.5, 0.5, 0.6])]
    return RESULT_SCHEMA.validate(tabulate(pd.concat(rows), samples, "published"))


def test_mean_and_spread_over_folds_and_seeds(table):
    row = table.set_index("model").loc["no_task"]
    assert row["sim_mean"] == pytest.approx(0.5)
    assert row["sim_sd"] == pytest.approx(np.std([0.4, 0.5, 0.5, 0.6], ddof=1), abs=1e-6)
    assert (row["n_folds"], row["n_seeds"]) == (2, 2)
    assert (row["paper_sim"], row["paper_acc"], row["paper_prec"]) == (0.81, 0.85, 0.87)


def test_rows_stand_in_the_papers_order_with_their_ceilings(table):
    assert table["model"].tolist() == [
        "no_task", "task_vector", "task_blind", "best_constant", "all_types", "literature",
    ]  # fmt: skip
    rows = table.set_index("model")
    assert rows.loc["no_task", "ceiling_sim"] == pytest.approx(0.5)
    assert rows.loc["task_vector", "ceiling_sim"] == 1.0
    assert rows.loc["task_blind", "sim_mean"] == pytest.approx(0.5)
    assert rows.loc["literature", "paper_sim"] == 0.93


def test_tables_of_different_backbones_are_not_mixed():
    rows = metrics("no_task", [0.5, 0.5])
    rows.loc[0, "backbone"] = "efficientnet_lite0"
    counts = pd.DataFrame([[1] * 6], columns=list(COUNTS)).assign(object="mug", task="use")
    with pytest.raises(ValueError, match="different backbone"):
        tabulate(rows, samples_from_counts(counts), "published")


def test_markdown_names_backbone_and_weights(table):
    text = markdown(table)
    assert "| no_task | published | 0.500 ± 0.082 |" in text
    assert "mobilenet_v2, a.pth (0a1b2c3d), 2 groups x 2 seeds" in text
    assert "nan" not in text


def test_curves_have_a_row_a_member_and_epoch():
    members = [
        Member("0", 0, np.arange(2), np.arange(0)),
        Member("1", 0, np.arange(2), np.arange(0)),
    ]
    table = curve_table(members, np.arange(12.0).reshape(3, 2, 2))
    last = table.query("group == '1' and epoch == 3")
    assert last[["train_loss", "test_loss"]].to_numpy().tolist() == [[10, 11]]
