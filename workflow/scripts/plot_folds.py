"""Draw every fold and seed with the mean and the paper's figure."""

from collections.abc import Sequence

import pandas as pd

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.predictors.scoring import METRIC_SCHEMA
from grasptypes.reports.training_figures import draw_folds
from grasptypes.tables import read_table


def plot_folds(metrics: Sequence[str], target: str) -> None:
    """Draw the rows of all tables of metrics."""
    rows = pd.concat([read_table(path, METRIC_SCHEMA) for path in metrics], ignore_index=True)
    save_figure(draw_folds(rows), target)


if __name__ == "__main__":
    with job(snakemake.log):
        plot_folds(snakemake.input.metrics, snakemake.output.figure)
