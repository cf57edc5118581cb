"""The predictor for unseen objects in MLflow: a parent run with Table III, and a run per fold."""

from __future__ import annotations

import json
from collections.abc import Mapping

import pandas as pd

from grasptypes.predictors.families import Families, family_folds
from grasptypes.predictors.general_predictor import GENERAL
from grasptypes.predictors.general_protocol import KINDS, SIMULATED, WITH_SIZE
from grasptypes.predictors.metrics import METRICS
from grasptypes.reports.table3 import object_means, score
from grasptypes.runs.tracking import RunRecord, run_key
from grasptypes.settings.general import GeneralSettings

# The measures of Table III in the order of `METRICS`.
MEASURES = ("similarity", "accuracy", "precision", "similarity_shares")


def general_record(
    answers: pd.DataFrame,
    samples: pd.DataFrame,
    table: pd.DataFrame,
    families: Families,
    how: tuple[GeneralSettings, int],
    times_ms: tuple[int, int],
    tags: Mapping[str, str],
) -> RunRecord:
    """The parent run, and below it a run for each group of held-out kinds.

    The measures that all runs of the project have are those of answers with size and mass about
    held-out kinds; the parent has every row of Table III besides.

    Args:
        answers: of `general_protocol.ANSWER_SCHEMA`.
        samples: labels of kinds.
        table: Table III, of `table3.TABLE_SCHEMA`.
        families: of all kinds that were learned from.
        how: settings and seed that the answers came from.
        times_ms: start and end of the job, milliseconds since 1970.
        tags: the hand, and what is not part of the result.
    """
    settings, seed = how
    flat = pd.json_normalize(settings.head.model_dump()).to_dict("records")[0]
    stated = {"hand": tags["hand"], "labels": SIMULATED, "model": GENERAL}
    stated |= {"backbone": settings.backbone, **flat}
    params = {name: str(value) for name, value in stated.items()}
    content = json.dumps([params, table.to_dict("records")], sort_keys=True)
    key = run_key(content)
    asked = answers[(answers["shown"] == KINDS) & (answers["model"] == WITH_SIZE)]
    means = object_means(score(asked, samples)).reset_index()
    folds = family_folds(families, settings.protocol.folds, seed)
    children = []
    for number, fold in enumerate(folds):
        mine = means[[bool(families[name] & fold) for name in means["object"]]]
        children.append(
            RunRecord(
                key=run_key(key, str(number)),
                name=f"fold {number}",
                times_ms=times_ms,
                params={**params, "fold": str(number), "families": ", ".join(sorted(fold))},
                metrics=_measures(mine[list(MEASURES)].mean()),
                curves={},
                tags=tags,
            )
        )
    summary = _measures(means[list(MEASURES)].mean())
    for row in table.to_dict("records"):
        for name in MEASURES:
            summary[f"{row['shown']}.{row['labels']}.{row['model']}.{name}"] = float(row[name])
    return RunRecord(key, f"{SIMULATED} {GENERAL}", times_ms, params, summary, {}, tags, children)


def _measures(row: pd.Series) -> dict[str, float]:
    return {name: float(row[mine]) for name, mine in zip(METRICS, MEASURES, strict=True)}
