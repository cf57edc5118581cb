"""Compare the rule's labels with the people's on the published poses."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from grasptypes.errors import InputError
from grasptypes.jobs import job
from grasptypes.labels.agreement import (
    AGREEMENT_SCHEMA,
    THRESHOLD_SCHEMA,
    TYPES,
    Judged,
    agreement,
    confusion,
    cross_validate,
    describe_fit,
)
from grasptypes.labels.grasp_type import Thresholds, classify
from grasptypes.labels.label_pictures import draw_confusion, save_figure
from grasptypes.labels.published_data import judge_published, lacking_data
from grasptypes.labels.published_source import published_path
from grasptypes.tables import write_table

OWN_OBJECTS = Path("data/objects")


def evaluate_labels(judged: Judged, settings: Mapping[str, Any], table: Path, figure: Path) -> str:
    """Score the thresholds of the parameters; returns a line to log."""
    predicted = classify(judged.measures, Thresholds(**settings["thresholds"]))
    scores = agreement(judged, predicted, describe_fit(judged.objects, settings["fitted_on"]))
    write_table(scores, table, AGREEMENT_SCHEMA)
    total = scores.iloc[-1]
    line = f"{total.n} poses: accuracy {total.accuracy:.3f}, kappa {total.kappa:.3f}"
    save_figure(draw_confusion(confusion(judged, predicted), TYPES, line), figure)
    return line


def validate_thresholds(judged: Judged, settings: Mapping[str, Any], table: Path) -> str:
    """Fit on all objects that `fitted_on` names but one, in turn; returns a line to log."""
    softness = Thresholds(**settings["softness"])
    known = judged.select(np.isin(judged.objects, settings["fitted_on"]))
    scores = cross_validate(known, softness)
    write_table(scores, table, THRESHOLD_SCHEMA)
    total = scores.iloc[-1]
    return f"leaving objects out: accuracy {total.accuracy:.3f}, kappa {total.kappa:.3f}"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        settings, out = snakemake.params.settings, snakemake.output
        lacking = lacking_data(os.environ)
        if lacking:
            raise InputError("reports/label_agreement.csv", "", f"cannot be made: {lacking}")
        judged = judge_published(os.environ, OWN_OBJECTS, snakemake.params.scale, settings)
        fitted = {*judged.objects} & {*settings["fitted_on"]}
        if len(fitted) < 2:
            message = f"has grasps of {len(fitted)} of the objects that grasp_types.fitted_on names"
            raise InputError(published_path(os.environ), "", f"{message}; 2 are needed")
        log.info(evaluate_labels(judged, settings, Path(out.table), Path(out.figure)))
        log.info(validate_thresholds(judged, settings, Path(out.validation)))
