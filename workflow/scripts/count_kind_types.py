"""Count the grasp types of kinds; pairs with too few valid grasps have no label."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.dataset import label_grasps
from grasptypes.labels.grasp_type import INVALID
from grasptypes.labels.samples import COUNTS, SAMPLE_SCHEMA, TYPES, samples_from_counts
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.settings.grasp_types import LabellingRule
from grasptypes.synthesis.grasps import GRASP_SCHEMA
from grasptypes.tables import read_table, write_table


def count_types(
    tables: Sequence[str], hand: Hand, grids: Mapping[str, str], rule: LabellingRule, least: int
) -> pd.DataFrame:
    """The samples of all pairs with at least `least` valid grasps.

    Args:
        tables: of `grasps.GRASP_SCHEMA`.
        grids: distance grids by object.
    """
    grasps = pd.concat([read_table(path, GRASP_SCHEMA) for path in tables], ignore_index=True)
    labelled = pd.concat(
        label_grasps(rows, hand, DistanceGrid.load(grids[str(name)]), rule)
        for name, rows in grasps.groupby("object", sort=True)
    )
    valid = labelled[labelled["grasp_type"] != INVALID]
    columns = dict(zip(TYPES, COUNTS, strict=True))
    spelled = valid["grasp_type"].str.lower().str.replace(" ", "_").map(columns)
    counts = pd.crosstab([valid["object"], valid["task"]], spelled)
    counts = counts.reindex(columns=list(COUNTS), fill_value=0)
    return samples_from_counts(counts[counts.sum(axis=1) >= least].reset_index())


if __name__ == "__main__":
    with job(snakemake.log) as log:
        samples = count_types(
            snakemake.input.grasps,
            load_hand(snakemake.params.hand["name"]),
            {Path(path).parent.name: path for path in snakemake.input.grids},
            LabellingRule.check(snakemake.params.settings),
            snakemake.params.least,
        )
        write_table(samples, snakemake.output.samples, SAMPLE_SCHEMA)
        log.info("%d pairs of %d have a label", len(samples), len(snakemake.input.grasps))
