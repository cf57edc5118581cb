"""Test the network that names roles on scans, against our own models of the objects."""

from pathlib import Path

import pandas as pd
import trimesh

from grasptypes.jobs import job
from grasptypes.segmentation.evaluation import SCAN_SCHEMA, scan_row
from grasptypes.segmentation.network import read_network
from grasptypes.segmentation.true_roles import TrueRoles
from grasptypes.settings.objects import Resolution
from grasptypes.settings.segmentation import SegmentationSettings
from grasptypes.tables import write_table

if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        settings = SegmentationSettings.check(params.settings)
        network = read_network(snakemake.input.network)
        resolution = Resolution.check(params.resolution)
        rows = []
        for path in map(Path, params.scans):
            mesh = trimesh.load_mesh(path, process=False).apply_scale(params.scale)
            true = TrueRoles.of_model(path.stem, params.scale, resolution)
            rows.append(scan_row(mesh, path.stem, true, settings, network))
        write_table(pd.DataFrame(rows), snakemake.output.table, SCAN_SCHEMA)
