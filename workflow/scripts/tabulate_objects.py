"""Tabulate and draw each model's results on each object, known and unseen."""

from collections.abc import Mapping

import pandas as pd

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.scoring import METRIC_SCHEMA, PREDICTION_SCHEMA
from grasptypes.reports.breakdown import KNOWN, OBJECT_SCHEMA, UNSEEN, by_left_out_object, by_object
from grasptypes.reports.breakdown_figures import draw_objects
from grasptypes.tables import read_table, write_table


def tabulate_objects(
    results: Mapping[tuple[str, str], tuple[str, str]],
    samples: Mapping[str, str],
    table: str,
    figure: str,
) -> None:
    """Write the table and the figure.

    Args:
        results: predictions on known objects and metrics on unseen ones, by labels and model.
        samples: tables of samples by labels.
    """
    parts = []
    for (labels, model), (predictions, metrics) in results.items():
        known = by_object(read_table(predictions, PREDICTION_SCHEMA), read_samples(samples[labels]))
        unseen = by_left_out_object(read_table(metrics, METRIC_SCHEMA))
        both = pd.concat([known.assign(objects=KNOWN), unseen.assign(objects=UNSEEN)])
        parts.append(both.assign(labels=labels, model=model))
    rows = pd.concat(parts, ignore_index=True)[list(OBJECT_SCHEMA.columns)]
    write_table(rows, table, OBJECT_SCHEMA)
    save_figure(draw_objects(rows), figure)


if __name__ == "__main__":
    with job(snakemake.log):
        names = [tuple(name) for name in snakemake.params.names]
        files = zip(snakemake.input.predictions, snakemake.input.unseen, strict=True)
        tabulate_objects(
            dict(zip(names, files, strict=True)),
            dict(zip(snakemake.params.labels, snakemake.input.samples, strict=True)),
            snakemake.output.table,
            snakemake.output.figure,
        )
