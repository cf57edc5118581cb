"""Compare the rule's labels with the people's on the published poses."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.agreement import (
    AGREEMENT_SCHEMA,
    THRESHOLD_SCHEMA,
    TYPES,
    Judged,
    agreement,
    confusion,
    cross_validate,
    describe_fit,
    judge,
)
from grasptypes.contacts import ContactSettings
from grasptypes.errors import InputError
from grasptypes.grasp_type import Thresholds, classify
from grasptypes.jobs import job
from grasptypes.label_pictures import draw_confusion, save_figure
from grasptypes.published import read_published
from grasptypes.published_objects import object_distances
from grasptypes.tables import write_table

HOW = {
    "GRASPTYPES_PUBLISHED_CSV": "name the authors' GraspTypesWithTasks.csv (GitHub, "
    "nikleer/GraspTypesWithTasks)",
    "GRASPTYPES_REFERENCE_MESHES": "name a folder of ContactDB's meshes as <object>.stl (GitHub, "
    "F1sh-Fang/contactdb_assets)",
}


def read_judged(settings: Mapping[str, Any], scale: float, own: Path) -> Judged:
    """Measure the published poses that the environment names."""
    paths = {}
    for variable, how in HOW.items():
        paths[variable] = os.environ.get(variable, "")
        if not Path(paths[variable] or "missing").exists():
            raise InputError(variable, paths[variable], f"is not there: let it {how}")
    published = read_published(paths["GRASPTYPES_PUBLISHED_CSV"])
    references = paths["GRASPTYPES_REFERENCE_MESHES"]
    names = sorted(published.object.unique())
    fields = object_distances(names, references, own, scale, settings["own_frames"])
    return judge(published, fields, ContactSettings(**settings["contacts"]))


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
    """Fit on all objects but one, in turn, those that `fitted_on` names; returns a line to log."""
    softness, start = (Thresholds(**settings[name]) for name in ("softness", "thresholds"))
    known = [name in settings["fitted_on"] for name in judged.objects]
    scores = cross_validate(judged.select(known), softness, start)
    write_table(scores, table, THRESHOLD_SCHEMA)
    total = scores.iloc[-1]
    return f"leaving objects out: accuracy {total.accuracy:.3f}, kappa {total.kappa:.3f}"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        settings, out = snakemake.params.settings, snakemake.output
        judged = read_judged(settings, snakemake.params.scale, Path(snakemake.params.own))
        log.info(evaluate_labels(judged, settings, Path(out.table), Path(out.figure)))
        log.info(validate_thresholds(judged, settings, Path(out.validation)))
