"""Test methods that name roles on families of kinds that they have not seen."""

import pandas as pd

from grasptypes.jobs import job
from grasptypes.segmentation.evaluation import (
    FOREST_METHOD,
    KIND_SCHEMA,
    NETWORK_METHOD,
    ROLE_SCHEMA,
    held_out_roles,
    kind_table,
    role_table,
)
from grasptypes.segmentation.folds import kind_folds, learned_rows
from grasptypes.segmentation.forest import RoleForest, grow_forest
from grasptypes.segmentation.network import read_network
from grasptypes.segmentation.samples import read_samples
from grasptypes.settings.segmentation import SegmentationSettings
from grasptypes.tables import write_table

if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        samples = read_samples(snakemake.input.samples)
        settings = SegmentationSettings.check(params.settings)
        protocol = settings.training.folds, params.seed, params.relatives
        networks = snakemake.input.networks

        def grow(fold: int) -> RoleForest:
            rows, key = learned_rows(samples.families, fold, *protocol)
            return grow_forest(samples, rows, key, settings.forest)

        methods = {NETWORK_METHOD: lambda fold: read_network(networks[fold]), FOREST_METHOD: grow}
        folds = kind_folds(samples.families, *protocol)
        answers = held_out_roles(samples, folds, methods, settings)
        kinds = [kind_table(method, samples, found) for method, found in answers.items()]
        roles = [role_table(method, samples, found) for method, found in answers.items()]
        write_table(pd.concat(kinds), snakemake.output.kinds, KIND_SCHEMA)
        write_table(pd.concat(roles), snakemake.output.roles, ROLE_SCHEMA)
