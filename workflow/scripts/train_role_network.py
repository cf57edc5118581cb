"""Train the network that names the roles of points on a surface, on all kinds."""

import numpy as np
import torch

from grasptypes.jobs import job
from grasptypes.segmentation.samples import read_samples
from grasptypes.segmentation.training import train_network
from grasptypes.settings.segmentation import RoleTrainingSettings

if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        samples = read_samples(snakemake.input.samples)
        settings = RoleTrainingSettings.check(snakemake.params.settings)
        rows, key = np.arange(len(samples.shapes)), ("all", snakemake.params.seed)
        train_network(samples, rows, settings, key).write(snakemake.output.network)
