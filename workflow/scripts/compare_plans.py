"""Plan grasps of all objects with types chosen first and without, and compare the effort."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from grasptypes.files import write_text
from grasptypes.jobs import job
from grasptypes.labels.samples import LABELS, read_samples
from grasptypes.objects.variants import base_of
from grasptypes.planning.plan_comparison import (
    CHOICES,
    LABELLED,
    PLANNING_SCHEMA,
    PREDICTED,
    Case,
    compare,
    text,
)
from grasptypes.planning.planner import Workshop
from grasptypes.planning.unseen_types import unseen_types
from grasptypes.predictors.prediction import spelled
from grasptypes.predictors.problem import read_problem
from grasptypes.tables import write_table


def cases(
    inputs: Mapping[str, Any],
    folders: Mapping[str, Path],
    tasks: Mapping[str, Mapping[str, int]],
    params: Mapping[str, Any],
) -> Sequence[Case]:
    """All plans to be made.

    Args:
        inputs: those of `read_problem`, and the hand's URDF.
        folders: of the prepared objects, by name.
        tasks: the section of params.yaml, those that the labels know.
        params: the other sections.
    """
    settings = params["plan"]["comparison"]
    model = params["predict"]["labels"], params["predict"]["model"]
    problem = read_problem(inputs, model, tasks, params["predictors"])
    predicted = unseen_types(problem, settings["seeds"], params["seed"])
    contact_params = {**params["contact_maps"], "sessions": settings["sessions"]}
    found = []
    for row in read_samples(inputs["samples"]).itertuples():
        name = str(row.object), str(row.task)
        if name[0] != base_of(name[0]):
            continue
        kinds = [spelled(label.removeprefix("label_")) for label in LABELS if getattr(row, label)]
        chosen = predicted.get(name) or predicted[name[0], ""]  # "" where the model sees no task
        types = {PREDICTED: chosen, LABELLED: kinds}
        shop = Workshop(folders[name[0]], Path(inputs["hand"]), name, params["seed"], params)
        found += [Case(shop, choice, types, contact_params) for choice in CHOICES]
    return found


if __name__ == "__main__":
    with job(snakemake.log) as log:
        plans = cases(
            dict(snakemake.input.items()),
            {Path(file).parent.name: Path(file).parent for file in snakemake.input.objects},
            snakemake.params.tasks,
            snakemake.params.params,
        )
        table = compare(plans, snakemake.threads, log.info)
        write_table(table, snakemake.output.table, PLANNING_SCHEMA)
        write_text(snakemake.output.markdown, text(table))
