"""Compare the rule's labels with the human labels of the published poses."""

import os
from collections.abc import Collection, Iterable
from pathlib import Path

import numpy as np

from grasptypes.errors import InputError
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.agreement import (
    AGREEMENT_SCHEMA,
    THRESHOLD_SCHEMA,
    LabelledGrasps,
    agreement,
    confusion,
    cross_validate,
    describe_fit,
    groups_of,
)
from grasptypes.labels.grasp_type import TYPES, classify, limits
from grasptypes.labels.label_pictures import draw_confusion, save_figure
from grasptypes.labels.label_sources import published_path
from grasptypes.labels.published_data import labelled_grasps, lacking_data
from grasptypes.settings.grasp_types import GraspTypeSettings
from grasptypes.tables import write_table

OWN_OBJECTS = Path("data/objects")


def evaluate_labels(
    grasps: LabelledGrasps, settings: GraspTypeSettings, table: Path, figure: Path
) -> str:
    """Score the thresholds of the parameters; returns a line for the log."""
    predicted = classify(grasps.measures, limits(settings.thresholds))
    scores = agreement(grasps, predicted, describe_fit(grasps.objects, settings.fitted_on))
    write_table(scores, table, AGREEMENT_SCHEMA)
    total = scores.iloc[-1]
    line = f"{total.n} poses: accuracy {total.accuracy:.3f}, kappa {total.kappa:.3f}"
    save_figure(draw_confusion(confusion(grasps, predicted), TYPES, line), figure)
    return line


def validate_thresholds(
    grasps: LabelledGrasps,
    settings: GraspTypeSettings,
    relatives: Iterable[Collection[str]],
    table: Path,
) -> str:
    """Cross-validate over the objects in `fitted_on`; returns a line for the log."""
    known = grasps.select(np.isin(grasps.objects, settings.fitted_on))
    scores = cross_validate(known, settings.softness, relatives)
    write_table(scores, table, THRESHOLD_SCHEMA)
    total = scores.iloc[-1]
    score = f"accuracy {total.accuracy:.3f}, kappa {total.kappa:.3f}"
    return f"leaving objects out with their relatives: {score}"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        settings = GraspTypeSettings.check(snakemake.params.settings)
        out = snakemake.output
        hand = load_hand(snakemake.params.hand["name"])
        lacking = lacking_data(os.environ)
        if lacking:
            raise InputError("reports/label_agreement.csv", "", f"cannot be made: {lacking}")
        grasps = labelled_grasps(os.environ, hand, OWN_OBJECTS, snakemake.params.scale, settings)
        fitted = {*grasps.objects} & {*settings.fitted_on}
        relatives = snakemake.params.relatives
        if len({*groups_of(fitted, relatives).values()}) < 2:
            message = f"has grasps of {len(fitted)} of the objects that grasp_types.fitted_on names"
            needed = "2 that are no relatives are needed"
            raise InputError(published_path(os.environ), "", f"{message}; {needed}")
        log.info(evaluate_labels(grasps, settings, Path(out.table), Path(out.figure)))
        log.info(validate_thresholds(grasps, settings, relatives, Path(out.validation)))
