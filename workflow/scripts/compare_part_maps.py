"""Compare contact maps of parts that networks find with those of an object's true parts."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from grasptypes.jobs import job
from grasptypes.kinds.library import read_kind
from grasptypes.objects.object_geometry import read_object
from grasptypes.planning.part_maps import PART_MAP_SCHEMA, compare_maps
from grasptypes.segmentation.folds import kind_folds, object_fold
from grasptypes.segmentation.network import read_network, trained_network
from grasptypes.settings.params import Params
from grasptypes.tables import write_table


def compare_all(
    folders: Sequence[Path], kinds: Sequence[str], networks: Sequence[str], params: Params
) -> pd.DataFrame:
    """The rows of all objects.

    Args:
        folders: of the prepared objects.
        kinds: that the networks learned from.
        networks: of each fold of these kinds.
    """
    own = params.general.protocol.families
    families = np.array([read_kind(kind).family for kind in kinds])
    folds = kind_folds(families, len(networks), params.seed, own.values())
    fold_of = dict(zip(families.tolist(), folds.tolist(), strict=True))
    rows = []
    for folder in folders:
        fold = object_fold(folder.name, own[folder.name], fold_of)
        left_out = read_network(networks[fold])
        for task in params.tasks:
            geometry = read_object(folder)
            rows += compare_maps(geometry, task, left_out, trained_network(), params)
    return pd.DataFrame(rows).round(4)


if __name__ == "__main__":
    with job(snakemake.log):
        inputs, given = snakemake.input, snakemake.params
        folders = [Path(path).parent for path in inputs.properties]
        params = Params.check(given.params)
        table = compare_all(folders, given.kinds, inputs.networks, params)
        write_table(table, snakemake.output.table, PART_MAP_SCHEMA)
