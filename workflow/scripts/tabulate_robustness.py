"""Tabulate and draw the tests of all recorded grasps."""

from collections.abc import Mapping, Sequence

import pandas as pd

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.reports.robustness_figure import draw_robustness
from grasptypes.robustness.tables import (
    CONFUSION_SCHEMA,
    CORRELATION_SCHEMA,
    ROBUSTNESS_SCHEMA,
    SUMMARY_SCHEMA,
    confusion,
    correlations,
    summary,
)
from grasptypes.tables import read_table, write_table


def write_tables(paths: Sequence[str], outputs: Mapping[str, str]) -> None:
    """Write the tables and the figure of all objects' tests."""
    tests = pd.concat([read_table(path, ROBUSTNESS_SCHEMA) for path in paths], ignore_index=True)
    write_table(tests, outputs["grasps"], ROBUSTNESS_SCHEMA)
    write_table(summary(tests), outputs["table"], SUMMARY_SCHEMA)
    write_table(confusion(tests), outputs["confusion"], CONFUSION_SCHEMA)
    write_table(correlations(tests), outputs["correlations"], CORRELATION_SCHEMA)
    save_figure(draw_robustness(tests), outputs["figure"])


if __name__ == "__main__":
    with job(snakemake.log):
        write_tables(snakemake.input.tests, snakemake.output)
