"""Test networks that name roles on families of kinds that they have not seen."""

import torch

from grasptypes.jobs import job
from grasptypes.segmentation.evaluation import (
    KIND_SCHEMA,
    ROLE_SCHEMA,
    held_out_roles,
    kind_table,
    role_table,
)
from grasptypes.segmentation.samples import read_samples
from grasptypes.settings.segmentation import SegmentationSettings
from grasptypes.tables import write_table

if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        samples = read_samples(snakemake.input.samples)
        settings = SegmentationSettings.check(snakemake.params.settings)
        found = held_out_roles(samples, settings, snakemake.params.seed)
        write_table(kind_table(samples, found), snakemake.output.kinds, KIND_SCHEMA)
        write_table(role_table(samples, found), snakemake.output.roles, ROLE_SCHEMA)
