"""Tabulate and draw how well models work that are told one of many tasks."""

from collections.abc import Mapping, Sequence

import pandas as pd

from grasptypes.files import write_text
from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.many_task_tables import (
    TABLE_SCHEMA,
    TRIAL_SCHEMA,
    label_similarity,
    markdown,
    summarize,
)
from grasptypes.reports.many_tasks_figure import draw_many_tasks
from grasptypes.tables import read_table, write_table


def tabulate_many_tasks(
    metrics: Sequence[str], samples: str, tasks: Sequence[str], outputs: Mapping[str, str]
) -> str:
    """Write the table as CSV, Markdown and figure; returns a line to log."""
    trials = pd.concat([read_table(path, TRIAL_SCHEMA) for path in metrics], ignore_index=True)
    pairs = read_samples(samples)
    table = summarize(trials, pairs, tasks)
    write_table(table, outputs["table"], TABLE_SCHEMA)
    write_text(outputs["markdown"], markdown(table))
    save_figure(draw_many_tasks(table), outputs["figure"])
    numbers = sorted(set(trials["tasks"]))
    alike = [label_similarity(pairs[pairs["task"].isin(tasks[:number])]) for number in numbers]
    found = zip(numbers, alike, strict=True)
    return "labels of an object's tasks are similar: " + ", ".join(
        f"{value:.3f} with {number} tasks" for number, value in found
    )


if __name__ == "__main__":
    with job(snakemake.log) as log:
        log.info(
            tabulate_many_tasks(
                snakemake.input.metrics,
                snakemake.input.samples,
                snakemake.params.tasks,
                dict(snakemake.output.items()),
            )
        )
