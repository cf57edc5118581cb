"""Tabulate metrics with the paper and the ceilings: as CSV, Markdown and a figure."""

from collections.abc import Mapping, Sequence

import pandas as pd

from grasptypes.files import write_text
from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.scoring import METRIC_SCHEMA
from grasptypes.reports.result_text import markdown
from grasptypes.reports.results import RESULT_SCHEMA, tabulate
from grasptypes.reports.table_figure import draw_table
from grasptypes.tables import read_table, write_table


def tabulate_results(
    metrics: Sequence[str], samples: Mapping[str, str], outputs: Mapping[str, str], unseen: bool
) -> None:
    """Write one table for all label sources in `samples` (source to table of samples)."""
    rows = pd.concat([read_table(path, METRIC_SCHEMA) for path in metrics], ignore_index=True)
    tables = [
        tabulate(rows[rows["labels"] == labels], read_samples(path), labels, unseen)
        for labels, path in samples.items()
    ]
    table = pd.concat(tables, ignore_index=True).drop_duplicates(ignore_index=True)
    write_table(table, outputs["table"], RESULT_SCHEMA)
    write_text(outputs["markdown"], markdown(table))
    save_figure(draw_table(table), outputs["figure"])


if __name__ == "__main__":
    with job(snakemake.log):
        sources = zip(snakemake.params.labels, snakemake.input.samples, strict=True)
        outputs = dict(snakemake.output.items())
        tabulate_results(snakemake.input.metrics, dict(sources), outputs, snakemake.params.unseen)
