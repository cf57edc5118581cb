"""Test the network that names roles on scans: its parts against those of our own models of the
objects."""

from pathlib import Path

import pandas as pd
import trimesh

from grasptypes.jobs import job
from grasptypes.kinds.catalogue import build
from grasptypes.objects.preparation import part_surface, scaled_parts
from grasptypes.segmentation.evaluation import SCAN_SCHEMA, scan_row, transferred_roles
from grasptypes.segmentation.network import RoleNetwork, read_network
from grasptypes.segmentation.parts import find_parts
from grasptypes.segmentation.samples import sample_evenly
from grasptypes.settings.objects import Resolution
from grasptypes.settings.roles import read_roles
from grasptypes.settings.segmentation import SegmentationSettings
from grasptypes.tables import write_table


def recognise(
    path: Path,
    network: RoleNetwork,
    settings: SegmentationSettings,
    scale: float,
    resolution: Resolution,
) -> dict[str, object]:
    """The row of one scan."""
    mesh = trimesh.load_mesh(path, process=False).apply_scale(scale)
    points_m, face = sample_evenly(mesh, settings.descriptors.points, path.stem)
    normals = mesh.face_normals[face]
    models = scaled_parts(build(path.stem), scale)
    surface = part_surface(models, resolution.surface_tolerance_m, resolution.surface_edge_m)
    role_of = {part.name: part.role.role for part in models if part.role}
    order = list(read_roles().roles)
    roles = [order.index(role_of[str(name)]) for name in surface.part_names]
    true = transferred_roles(surface, roles, points_m, normals)
    return scan_row(path.stem, find_parts(points_m, normals, settings, network), true)


if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        settings = SegmentationSettings.check(params.settings)
        network = read_network(snakemake.input.network)
        resolution = Resolution.check(params.resolution)
        rows = [
            recognise(Path(path), network, settings, params.scale, resolution)
            for path in params.scans
        ]
        write_table(pd.DataFrame(rows), snakemake.output.table, SCAN_SCHEMA)
