"""Plan grasps of all objects with types chosen first and without, and compare the effort."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from grasptypes.files import write_text
from grasptypes.jobs import job
from grasptypes.labels.samples import LABELS, read_samples
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
    inputs: Mapping[str, Any], folders: Mapping[str, str], params: Mapping[str, Any]
) -> Sequence[Case]:
    """All plans to be made.

    Args:
        inputs: those of `read_problem`, and the hand's URDF.
        folders: of the prepared objects, by name.
        params: the whole of params.yaml.
    """
    settings = params["plan"]["comparison"]
    model = params["predict"]["labels"], params["predict"]["model"]
    problem = read_problem(inputs, model, params["tasks"], params["predictors"])
    predicted = unseen_types(problem, settings["seeds"], params["seed"])
    contact_params = {**params["contact_maps"], "sessions": settings["sessions"]}
    found = []
    for row in read_samples(inputs["samples"]).itertuples():
        name = str(row.object), str(row.task)
        kinds = [spelled(label.removeprefix("label_")) for label in LABELS if getattr(row, label)]
        chosen = predicted.get(name) or predicted[name[0], ""]  # "" where the model sees no task
        types = {PREDICTED: chosen, LABELLED: kinds}
        folder = Path(folders[name[0]])
        shop = Workshop(folder, Path(inputs["hand"]), name, params["seed"], params)
        found += [Case(shop, choice, types, contact_params) for choice in CHOICES]
    return found


if __name__ == "__main__":
    with job(snakemake.log) as log:
        folders = {Path(file).parent.name: Path(file).parent for file in snakemake.input.objects}
        inputs = dict(snakemake.input.items())
        table = compare(
            cases(inputs, folders, snakemake.params.params), snakemake.threads, log.info
        )
        write_table(table, snakemake.output.table, PLANNING_SCHEMA)
        write_text(snakemake.output.markdown, text(table))
