"""Tabulate the model that is shown the task beside those that are told it otherwise."""

from collections.abc import Mapping, Sequence

import pandas as pd

from grasptypes.files import write_text
from grasptypes.jobs import job
from grasptypes.predictors.demonstrations import (
    DEMONSTRATION_SCHEMA,
    TRIAL_SCHEMA,
    markdown,
    summarize,
)
from grasptypes.predictors.scoring import METRIC_SCHEMA
from grasptypes.tables import read_table, write_table


def tabulate_demonstrations(
    trials: Sequence[str], others: Sequence[str], outputs: Mapping[str, str]
) -> None:
    """Write the table as CSV and Markdown.

    Args:
        others: metrics of the models to compare with.
    """
    table = summarize(
        pd.concat([read_table(path, TRIAL_SCHEMA) for path in trials]),
        pd.concat([read_table(path, METRIC_SCHEMA) for path in others]),
    )
    write_table(table, outputs["table"], DEMONSTRATION_SCHEMA)
    write_text(outputs["markdown"], markdown(table))


if __name__ == "__main__":
    with job(snakemake.log):
        tabulate_demonstrations(
            snakemake.input.trials, snakemake.input.others, dict(snakemake.output.items())
        )
