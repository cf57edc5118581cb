"""Tabulate and draw each model's results for each grasp type."""

from collections.abc import Mapping

import pandas as pd

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.scoring import PREDICTION_SCHEMA
from grasptypes.reports.breakdown import TYPE_SCHEMA, by_type
from grasptypes.reports.breakdown_figures import draw_types
from grasptypes.tables import read_table, write_table


def tabulate_types(
    predictions: Mapping[tuple[str, str], str],
    samples: Mapping[str, str],
    table: str,
    figure: str,
) -> None:
    """Write the table and the figure.

    Args:
        predictions: files of predictions by labels and model.
        samples: tables of samples by labels.
    """
    parts = [
        by_type(read_table(path, PREDICTION_SCHEMA), read_samples(samples[labels]))
        .assign(labels=labels, model=model)
        for (labels, model), path in predictions.items()
    ]  # fmt: skip
    rows = pd.concat(parts, ignore_index=True)[list(TYPE_SCHEMA.columns)]
    write_table(rows, table, TYPE_SCHEMA)
    save_figure(draw_types(rows), figure)


if __name__ == "__main__":
    with job(snakemake.log):
        names = [tuple(name) for name in snakemake.params.names]
        tabulate_types(
            dict(zip(names, snakemake.input.predictions, strict=True)),
            dict(zip(snakemake.params.labels, snakemake.input.samples, strict=True)),
            snakemake.output.table,
            snakemake.output.figure,
        )
