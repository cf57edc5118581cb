"""Table III: unseen objects, next to simpler answers."""

from collections.abc import Collection, Mapping

import pandas as pd

from grasptypes.files import write_text
from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.general_protocol import ANSWER_SCHEMA, SIMULATED
from grasptypes.reports.calibration_figure import draw_calibration
from grasptypes.reports.table3 import TABLE_SCHEMA, markdown, tabulate
from grasptypes.tables import read_table, write_table


def tabulate_general(
    answers: str,
    samples: Mapping[str, list[str]],
    targets: Mapping[str, str],
    unfitted: Collection[str],
    bins: int,
) -> None:
    """Write the table, its Markdown, and the calibration figure.

    Args:
        samples: files by label source; those of kinds are simulated.
    """
    told = read_table(answers, ANSWER_SCHEMA)
    known = {name: pd.concat(map(read_samples, paths)) for name, paths in samples.items()}
    table = tabulate(told, known, unfitted, bins)
    write_table(table, targets["table"], TABLE_SCHEMA)
    write_text(targets["markdown"], markdown(table))
    save_figure(draw_calibration(told, known, bins), targets["figure"])


if __name__ == "__main__":
    with job(snakemake.log):
        params, files = snakemake.params, snakemake.input
        tabulate_general(
            files.answers,
            {
                source: [path, files.kind_samples] if source == SIMULATED else [path]
                for source, path in zip(params.labels, files.samples, strict=True)
            },
            dict(snakemake.output.items()),
            params.unfitted,
            params.bins,
        )
