"""Write summaries of the results for DVC to show and compare."""

from pathlib import Path

import pandas as pd

from grasptypes.files import write_json
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.dataset import dataset_schema
from grasptypes.reports.distribution import DISTRIBUTION_SCHEMA
from grasptypes.reports.scores import grasp_scores, model_scores
from grasptypes.tables import read_table


def summarise_scores(
    known: list[str], unseen: str | None, models: dict[tuple[str, str], str]
) -> None:
    """Write one file per label source and model.

    Args:
        known: tables for known objects, one per label source.
        unseen: the table for left-out objects; None if there was only one object.
        models: output files by label source and model.
    """
    table = pd.concat([pd.read_csv(path) for path in known], ignore_index=True)
    names = sorted({model for _, model in models})
    scores = model_scores(table, pd.read_csv(unseen) if unseen else table[:0], names)
    for name, path in models.items():
        write_json(path, scores[name])


if __name__ == "__main__":
    with job(snakemake.log):
        files = {(Path(p).parent.name, Path(p).stem): p for p in snakemake.output.models}
        summarise_scores(snakemake.input.known, snakemake.input.unseen or None, files)
        schema = dataset_schema(load_hand(snakemake.params.hand["name"]))
        dataset = read_table(snakemake.input.grasps, schema)
        compared = snakemake.input.distribution
        distribution = read_table(compared, DISTRIBUTION_SCHEMA) if compared else None
        write_json(snakemake.output.grasps, grasp_scores(dataset, distribution))
