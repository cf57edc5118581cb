"""Analyse the labels as the paper does: a table and two figures."""

from collections.abc import Mapping

import pandas as pd

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.reports.task_analysis import ANALYSIS_SCHEMA, analyse
from grasptypes.reports.task_figures import draw_analysis, draw_changes
from grasptypes.tables import write_table


def analyse_labels(samples: Mapping[str, str], outputs: Mapping[str, str]) -> None:
    """Write table and figures of all label sources in `samples` (source to table of samples)."""
    tables = {labels: read_samples(path) for labels, path in samples.items()}
    parts = [analyse(table, labels) for labels, table in tables.items()]
    analysis = pd.concat(parts, ignore_index=True)
    write_table(analysis, outputs["table"], ANALYSIS_SCHEMA)
    save_figure(draw_analysis(analysis), outputs["figure"])
    save_figure(draw_changes(tables), outputs["changes"])


if __name__ == "__main__":
    with job(snakemake.log):
        sources = zip(snakemake.params.labels, snakemake.input.samples, strict=True)
        analyse_labels(dict(sources), dict(snakemake.output.items()))
