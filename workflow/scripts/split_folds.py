"""Split the images of all objects into folds."""

from collections.abc import Iterable
from pathlib import Path

import pandas as pd

from grasptypes.jobs import job
from grasptypes.predictors.folds import FOLD_SCHEMA, split
from grasptypes.tables import write_table


def split_folds(poses: Iterable[str | Path], target: str | Path, folds: int, seed: int) -> None:
    """Write the fold of every image; `poses` are tables named after their objects."""
    views = {Path(path).stem: len(pd.read_csv(path)) for path in poses}
    write_table(split(views, folds, seed), target, FOLD_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        split_folds(
            snakemake.input.poses,
            snakemake.output.folds,
            snakemake.params.folds,
            snakemake.params.seed,
        )
