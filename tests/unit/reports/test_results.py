"""Tables of results beside the paper and the ceilings."""

import numpy as np
import pandas as pd
import pytest

from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.predictors.learning_inputs import BackboneRecord
from grasptypes.predictors.training import Member
from grasptypes.reports.result_text import markdown
from grasptypes.reports.results import (
    METRIC_SCHEMA,
    RESULT_SCHEMA,
    constant_rows,
    curve_table,
    tabulate,
    with_source,
)

BACKBONE = BackboneRecord("mobilenet_v2", "a.pth (0a1b2c3d)", "0a1b2c3d", 224)


def metrics(model, similarities):
    rows = [
        {"group": str(k % 2), "seed": k // 2, "n_train": 8, "n_test": 2, "angular_similarity": s,
         "multilabel_accuracy": 0.5, "multilabel_precision": 1.0}
        for k, s in enumerate(similarities)
    ]  # fmt: skip
    table = with_source(pd.DataFrame(rows), ("published", model), BACKBONE, "none")
    return METRIC_SCHEMA.validate(table)


def tabulated(unseen):
    counts = pd.DataFrame([[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0]], columns=list(COUNTS))
    samples = samples_from_counts(counts.assign(object="mug", task=["use", "handoff"]))
    rows = [metrics("task_vector", [0.9, 0.9, 0.9, 0.9]), metrics("no_task", [0.4, 0.5, 0.4, 0.5])]
    return RESULT_SCHEMA.validate(tabulate(pd.concat(rows), samples, "published", unseen))


@pytest.fixture
def table():
    return tabulated(unseen=False)


def test_mean_and_spread_over_folds_and_seeds(table):
    row = table.set_index("model").loc["no_task"]
    assert row["sim_mean"] == pytest.approx(0.45)
    assert row["sim_sd"] == pytest.approx(np.std([0.4, 0.5, 0.4, 0.5], ddof=1), abs=1e-6)
    assert (row["n_folds"], row["n_seeds"]) == (2, 2)
    assert (row["paper_sim"], row["paper_acc"], row["paper_prec"]) == (0.81, 0.85, 0.87)


def test_rows_stand_in_the_papers_order_with_their_ceilings(table):
    assert table["model"].tolist() == [
        "no_task", "task_vector", "task_blind", "best_constant", "all_types", "best_constant_joint",
        "literature",
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
    assert "| no_task | published | 0.450 ± 0.058 |" in text
    assert "mobilenet_v2, a.pth (0a1b2c3d), 2 groups x 2 seeds" in text
    assert "nan" not in text


def test_nothing_of_the_paper_stands_beside_unseen_objects():
    table = tabulated(unseen=True)
    assert list(table) == list(RESULT_SCHEMA.columns)
    assert table[["paper_sim", "paper_acc", "paper_prec"]].isna().all(axis=None)
    assert "literature" not in table["model"].tolist()
    text = markdown(table)
    assert "paper" not in text
    assert "| no_task | published | 0.450 ± 0.058 | 0.500" in text


def test_models_below_the_best_constant_answer_are_named(table):
    verdict = (
        "published: 1 of 2 models are less similar to the labels of unseen objects than the best "
        "constant answer, which is chosen knowing all labels: no_task (0.450 < 0.500).\n"
    )
    assert verdict in markdown(tabulated(unseen=True))
    assert "best constant answer" not in markdown(table)


def test_who_is_asked_for_joint_labels_has_a_constant_answer_of_its_own():
    counts = pd.DataFrame([[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0]], columns=list(COUNTS))
    samples = samples_from_counts(counts.assign(object="mug", task=["use", "handoff"]))
    rows = [metrics(model, [0.6, 0.6]) for model in ("task_vector", "ignores_task")]
    table = tabulate(pd.concat(rows), samples, "published")
    constant = constant_rows(table, "published")["sim_mean"]
    assert constant["task_vector"] == pytest.approx(0.5)  # between two types at right angles
    assert constant["ignores_task"] == pytest.approx(1.0)  # both types, for both tasks


def test_curves_have_a_row_a_member_and_epoch():
    members = [
        Member("0", 0, np.arange(2), np.arange(0)),
        Member("1", 0, np.arange(2), np.arange(0)),
    ]
    table = curve_table(members, np.arange(12.0).reshape(3, 2, 2))
    last = table.query("group == '1' and epoch == 3")
    assert last[["train_loss", "test_loss"]].to_numpy().tolist() == [[10, 11]]
