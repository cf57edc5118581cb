"""Plan grasps of all objects with and without choosing types first, and compare the effort."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from grasptypes.files import write_text
from grasptypes.jobs import job
from grasptypes.labels.samples import LABELS, read_samples
from grasptypes.objects.object_geometry import read_object
from grasptypes.objects.variants import base_of
from grasptypes.planning.plan_comparison import (
    CHOICES,
    LABELLED,
    PLANNING_SCHEMA,
    PREDICTED,
    Case,
    compare,
    held_out_types,
    text,
    unseen_types,
)
from grasptypes.planning.sessions import PlanningContext
from grasptypes.predictors.answers import spelled
from grasptypes.predictors.general_protocol import ANSWER_SCHEMA
from grasptypes.predictors.problem import read_problem
from grasptypes.settings.params import Params
from grasptypes.tables import read_table, write_table


def cases(
    inputs: Mapping[str, Any],
    folders: Mapping[str, Path],
    tasks: Mapping[str, int],
    params: Params,
) -> Sequence[Case]:
    """All plans to make.

    Args:
        inputs: answers of `general` if it chooses types, else those of `read_problem`.
        folders: of the prepared objects, by name.
        tasks: tasks with labels, each with its colour shift.
        params: all parameters.
    """
    if inputs["answers"]:
        predicted = held_out_types(read_table(inputs["answers"], ANSWER_SCHEMA))
    else:
        model = params.predict.labels, params.plan.comparison.model
        problem = read_problem(inputs, model, tasks, params.predictors)
        predicted = unseen_types(problem, params.plan.comparison.seeds, params.seed)
    found = []
    for row in read_samples(inputs["samples"]).itertuples():
        name = str(row.object), str(row.task)
        if name[0] != base_of(name[0]):
            continue
        kinds = [spelled(label.removeprefix("label_")) for label in LABELS if getattr(row, label)]
        chosen = predicted.get(name) or predicted[name[0], ""]  # "" if the task is unseen
        types = {PREDICTED: chosen, LABELLED: kinds}
        geometry = read_object(folders[name[0]])
        context = PlanningContext(geometry, name[1], name[0], params.hand, params)
        found += [Case(context, choice, types) for choice in CHOICES]
    return found


if __name__ == "__main__":
    with job(snakemake.log) as log:
        plans = cases(
            dict(snakemake.input.items()),
            {Path(file).parent.name: Path(file).parent for file in snakemake.input.objects},
            snakemake.params.tasks,
            Params.check(snakemake.params.params),
        )
        table = compare(plans, snakemake.threads, log.info)
        write_table(table, snakemake.output.table, PLANNING_SCHEMA)
        write_text(snakemake.output.markdown, text(table))
