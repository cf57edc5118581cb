"""Grasp types that predictors choose for unseen objects."""

from __future__ import annotations

import pandas as pd

from grasptypes.labels.samples import TYPES
from grasptypes.predictors.leaving_out import members_by_object
from grasptypes.predictors.prediction import Answer
from grasptypes.predictors.problem import LearningProblem
from grasptypes.predictors.protocol import try_splits


def unseen_types(
    problem: LearningProblem, seeds: int, seed: int
) -> dict[tuple[str, str], list[str]]:
    """Chosen types of every object and task, from predictors trained on all other objects.

    Variants of an object are left out with it, and have no prediction of their own. Predictions are
    averaged over the views, as for a user's mesh.

    Args:
        seeds: number of predictors per object, whose predictions are averaged too.
        seed: part of the key of every random draw.
    """
    examples = problem.examples
    members = members_by_object(examples.index["object"], seeds)
    key = ("unseen", problem.model, seed)
    predictions = try_splits(examples, members, problem.settings, key, problem.backbone).predictions
    return {
        (str(name), str(task)): _types(rows)
        for (name, task), rows in predictions.groupby(["object", "task"])
    }


def _types(rows: pd.DataFrame) -> list[str]:
    logits = rows[[f"logit_{kind}" for kind in TYPES]].to_numpy()
    return Answer.of_logits("", TYPES, logits).grasp_types
