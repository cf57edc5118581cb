"""Train the network that names the roles of points on a surface, on all kinds or without a fold."""

import torch

from grasptypes.jobs import job
from grasptypes.segmentation.folds import learned_rows
from grasptypes.segmentation.samples import read_samples
from grasptypes.segmentation.training import train_network
from grasptypes.settings.segmentation import RoleTrainingSettings

if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        torch.set_num_threads(snakemake.threads)
        samples = read_samples(snakemake.input.samples)
        settings = RoleTrainingSettings.check(params.settings)
        rows, key = learned_rows(
            samples.families, params.fold, settings.folds, params.seed, params.relatives
        )
        train_network(samples, rows, settings, key).write(snakemake.output.network)
