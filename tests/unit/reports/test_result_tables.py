"""Tables of results next to the paper and the ceilings."""

import re

import numpy as np
import pandas as pd
import pytest

from grasptypes.labels.samples import COUNTS, samples_from_counts
from grasptypes.predictors.scoring import METRIC_SCHEMA, with_source
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.reports.result_text import markdown
from grasptypes.reports.results import RESULT_SCHEMA, constant_rows, tabulate

WEIGHTS = {"weights": "a.pth (0a1b2c3d)", "sha256": "0a1b2c3d"}
BACKBONE = BackboneRecord(backbone="mobilenet_v2", **WEIGHTS, input_px=224)


OBJECTS = ("mug", "pan")


def metrics(model, similarities):
    """Similarities on both objects of the first seed, then of the second."""
    rows = [
        {"group": OBJECTS[k % 2], "seed": k // 2, "n_train": 8, "n_test": 2,
         "angular_similarity": s, "multilabel_accuracy": 0.5, "multilabel_precision": 1.0,
         "frequency_similarity": s / 2}
        for k, s in enumerate(similarities)
    ]  # fmt: skip
    table = with_source(pd.DataFrame(rows), ("published", model), BACKBONE, "none")
    return METRIC_SCHEMA.validate(table)


def known_samples():
    """A mug is used by type 0 and handed over by type 1; a pan is by type 1 and by type 0."""
    counts = pd.DataFrame(np.eye(6, dtype=int)[[0, 1, 1, 0]], columns=list(COUNTS))
    tasks = ["use", "handoff", "use", "handoff"]
    return samples_from_counts(counts.assign(object=np.repeat(OBJECTS, 2), task=tasks))


def tabulated(unseen):
    rows = [metrics("task_vector", [0.9, 0.9, 0.9, 0.9]), metrics("no_task", [0.4, 0.6, 0.2, 0.6])]
    table = tabulate(pd.concat(rows), known_samples(), "published", unseen)
    return RESULT_SCHEMA.validate(table)


@pytest.fixture
def table():
    return tabulated(unseen=False)


def test_mean_and_spread_over_folds_and_seeds(table):
    row = table.set_index("model").loc["no_task"]
    assert row["sim_mean"] == pytest.approx(0.45)
    assert row["sim_sd"] == pytest.approx(np.std([0.4, 0.6, 0.2, 0.6], ddof=1), abs=1e-6)
    assert (row["n_folds"], row["n_seeds"]) == (2, 2)
    assert (row["paper_sim"], row["paper_acc"], row["paper_prec"]) == (0.81, 0.85, 0.87)


def test_rows_stand_in_the_papers_order_with_their_ceilings(table):
    assert table["model"].tolist() == [
        "no_task", "task_vector", "e_inception_v3", "task_blind", "best_constant", "all_types",
        "best_constant_joint", "literature",
    ]  # fmt: skip
    rows = table.set_index("model")
    assert rows.loc["no_task", "ceiling_sim"] == pytest.approx(0.5)
    assert rows.loc["task_vector", "ceiling_sim"] == 1.0
    assert rows.loc["task_blind", "sim_mean"] == pytest.approx(0.5)
    assert rows.loc["literature", "paper_sim"] == 0.93
    assert rows.loc["no_task", "freq_mean"] == pytest.approx(0.225)
    assert rows.loc["no_task", "ceiling_freq"] == pytest.approx(0.5)


def test_a_network_without_weights_has_a_row_that_says_so(table):
    row = table.set_index("model").loc["e_inception_v3"]
    assert row["n_folds"] == 0
    assert row.filter(like="_mean").isna().all()
    text = markdown(table)
    assert "| e_inception_v3 | published |  |  |  |  |  |  |" in text
    assert "e_inception_v3 has no values: its weights could not be obtained." in text


def test_tables_of_different_backbones_are_not_mixed():
    rows = metrics("no_task", [0.5, 0.5])
    rows.loc[0, "backbone"] = "efficientnet_lite0"
    counts = pd.DataFrame([[1] * 6], columns=list(COUNTS)).assign(object="mug", task="use")
    with pytest.raises(ValueError, match="different backbone"):
        tabulate(rows, samples_from_counts(counts), "published")


def test_markdown_names_backbone_and_weights(table):
    text = markdown(table)
    assert "| no_task | published | 0.450 ± 0.191 |" in text
    assert "| 1.000 ± 0.000 | 0.225 ± 0.096 | 0.81 / 0.85 / 0.87 | 0.50 / 0.50 / 0.50 |" in text
    assert "mobilenet_v2, a.pth (0a1b2c3d), 2 groups x 2 seeds" in text
    assert not re.search("nan|constant_of_others", text)


def test_nothing_of_the_paper_stands_beside_unseen_objects():
    table = tabulated(unseen=True)
    assert list(table) == list(RESULT_SCHEMA.columns)
    assert table[["paper_sim", "paper_acc", "paper_prec"]].isna().all(axis=None)
    assert "literature" not in table["model"].tolist()
    text = markdown(table)
    assert "paper" not in text
    # 0.3 on the mug and 0.6 on the pan, each the mean of two repetitions.
    assert "| no_task | published | 0.450 ± 0.212 | 0.500" in text
    assert "standard deviation over objects left out" in text


def test_models_stand_beside_the_constant_answer_of_the_other_objects():
    table = tabulated(unseen=True)
    rows = table.set_index("model")
    # On the mug 0.3, on the pan 0.6; each object's types are half-way between those of the other.
    assert rows.loc["constant_of_others", "sim_mean"] == pytest.approx(0.5)
    assert rows.loc["no_task", "sim_over_constant"] == pytest.approx(-0.05)
    assert rows.loc["no_task", "sim_over_constant_se"] == pytest.approx(0.15)
    line = "standard error over 2 objects: no_task -0.050 ± 0.150, task_vector +0.400 ± 0.000.\n"
    assert line in markdown(table)


def test_who_is_asked_for_joint_labels_has_a_constant_answer_of_its_own():
    rows = [metrics(model, [0.6, 0.6]) for model in ("task_vector", "ignores_task")]
    table = tabulate(pd.concat(rows), known_samples(), "published", unseen=True)
    constant = constant_rows(table, "published")["sim_mean"]
    assert constant["task_vector"] == pytest.approx(0.5)  # between two types at right angles
    assert constant["ignores_task"] == pytest.approx(1.0)  # both types, for both tasks
    over = table.set_index("model")["sim_over_constant"]
    assert over["task_vector"] == pytest.approx(0.1)
    assert over["ignores_task"] == pytest.approx(-0.4)
