"""Tabulate and draw results on unseen objects against the number of training shapes."""

from collections.abc import Mapping, Sequence

import pandas as pd

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.generalisation import (
    GENERALISATION_SCHEMA,
    TRIAL_SCHEMA,
    constant_similarity,
    describe,
    summarize,
)
from grasptypes.reports.generalisation_figure import draw_generalisation
from grasptypes.tables import read_table, write_table


def tabulate_generalisation(
    metrics: Sequence[str], samples: Mapping[str, str], table: str, figure: str
) -> str:
    """Write the table and the figure; returns a line to log."""
    trials = pd.concat([read_table(path, TRIAL_SCHEMA) for path in metrics], ignore_index=True)
    constant = {
        (labels, model): value
        for labels, path in samples.items()
        for model, value in constant_similarity(read_samples(path)).items()
    }
    found = summarize(trials, constant)
    write_table(found, table, GENERALISATION_SCHEMA)
    save_figure(draw_generalisation(found), figure)
    return describe(found)


if __name__ == "__main__":
    with job(snakemake.log) as log:
        sources = zip(snakemake.params.labels, snakemake.input.samples, strict=True)
        log.info(
            tabulate_generalisation(
                snakemake.input.metrics,
                dict(sources),
                snakemake.output.table,
                snakemake.output.figure,
            )
        )
