"""Tabulate and draw results by the number of training images of each object."""

from collections.abc import Mapping, Sequence

import pandas as pd

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.ceilings import ceilings, counts_asked
from grasptypes.predictors.learning_curve import CURVE_SCHEMA, TRIAL_SCHEMA, summarize
from grasptypes.reports.learning_curve_figure import draw_learning_curve
from grasptypes.tables import read_table, write_table


def plot_learning_curve(
    metrics: Sequence[str], samples: Mapping[str, str], table: str, figure: str
) -> None:
    """Write the table and the figure.

    Args:
        samples: by label source.
    """
    trials = pd.concat([read_table(path, TRIAL_SCHEMA) for path in metrics], ignore_index=True)
    found = summarize(trials)
    write_table(found, table, CURVE_SCHEMA)
    blind = {
        labels: float(
            ceilings(counts_asked(read_samples(path), joint=False)).at[
                "task_blind", "angular_similarity"
            ]
        )
        for labels, path in samples.items()
    }
    save_figure(draw_learning_curve(found, blind), figure)


if __name__ == "__main__":
    with job(snakemake.log):
        sources = zip(snakemake.params.labels, snakemake.input.samples, strict=True)
        plot_learning_curve(
            snakemake.input.metrics,
            dict(sources),
            snakemake.output.table,
            snakemake.output.figure,
        )
