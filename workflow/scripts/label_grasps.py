"""Label and count all grasps: the dataset."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.dataset import dataset_schema, dataset_table, label_grasps, sample_table
from grasptypes.labels.samples import SAMPLE_SCHEMA
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.settings.grasp_types import LabellingRule
from grasptypes.synthesis.grasps import GRASP_SCHEMA
from grasptypes.tables import read_table, write_table


def label_all(
    tables: Sequence[str], hand: Hand, grids: Mapping[str, str], rule: LabellingRule
) -> pd.DataFrame:
    """The dataset of all grasp tables.

    Args:
        tables: of `grasps.GRASP_SCHEMA`.
        grids: distance grids by object.
    """
    grasps = pd.concat([read_table(path, GRASP_SCHEMA) for path in tables], ignore_index=True)
    return dataset_table(
        [
            label_grasps(rows, hand, DistanceGrid.load(grids[str(name)]), rule)
            for name, rows in grasps.groupby("object", sort=True)
        ],
        hand,
    )


if __name__ == "__main__":
    with job(snakemake.log) as log:
        grids = {Path(path).parent.name: path for path in snakemake.input.grids}
        hand = load_hand(snakemake.params.hand["name"])
        rule = LabellingRule.check(snakemake.params.settings)
        dataset = label_all(snakemake.input.grasps, hand, grids, rule)
        write_table(dataset, snakemake.output.grasps, dataset_schema(hand))
        samples = sample_table(dataset, snakemake.output.grasps, snakemake.params.least)
        write_table(samples, snakemake.output.samples, SAMPLE_SCHEMA)
        pairs = dataset[["Object", "Intent"]].drop_duplicates()
        log.info("%d grasps, %d valid", len(dataset), samples.n_valid.sum())
        log.info("%d of %d pairs have a label", len(samples), len(pairs))
