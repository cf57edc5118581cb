"""The results in short, from tables as the rules write them."""

import pandas as pd

from grasptypes.reports.scores import grasp_scores, model_scores


def table(*rows: tuple) -> pd.DataFrame:
    return pd.DataFrame(
        rows, columns=["labels", "model", "sim_mean", "acc_mean", "prec_mean", "freq_mean"]
    )


def test_a_model_has_its_measures_on_known_and_on_unseen_objects() -> None:
    known = table(
        ("simulated", "no_task", 0.84353, 0.9, 1.0, 0.8),
        ("published", "no_task", 0.5, 0.6, 0.7, 0.4),
        ("simulated", "best_constant", 0.1, 0.1, 0.1, 0.1),
        (None, "literature", None, None, None, None),
    )
    unseen = table(
        ("simulated", "no_task", 0.3, 0.4, 0.5, 0.2),
        ("simulated", "all_types", 0.1, 0.1, 0.1, 0.1),
    )
    scores = model_scores(known, unseen, ["no_task"])
    lower = {"similarity": 0.3, "accuracy": 0.4, "precision": 0.5, "frequencies": 0.2}
    assert scores == {
        ("simulated", "no_task"): {"similarity": 0.8435, "accuracy": 0.9, "precision": 1.0}
        | {"frequencies": 0.8, "unseen": lower},
        ("published", "no_task"): {"similarity": 0.5, "accuracy": 0.6, "precision": 0.7}
        | {"frequencies": 0.4},
    }


def test_grasps_are_counted_and_the_last_row_of_the_comparison_is_its_mean() -> None:
    dataset = pd.DataFrame({"GraspType": ["Precision", "Invalid", "Large Wrap"]})
    distribution = pd.DataFrame({"similarity": [0.1, 0.3, 0.2]})
    assert grasp_scores(dataset, distribution) == {"tried": 3, "valid": 2, "similarity": 0.2}
    assert grasp_scores(dataset, None) == {"tried": 3, "valid": 2}
