"""Prepare a shape of a kind: write its files, and a mesh with the role of every face."""

from pathlib import Path

from grasptypes.files import write_bytes
from grasptypes.jobs import job
from grasptypes.kinds.modelling import build_shape
from grasptypes.objects.preparation import prepare, scaled_parts
from grasptypes.objects.role_meshes import role_mesh
from grasptypes.settings.objects import Resolution


def prepare_kind(name: str, resolution: Resolution, folder: Path, roles: str) -> None:
    """Write the files of a shape to its folder, and the mesh with roles."""
    model = build_shape(name)
    prepare(name, model, resolution, folder)
    write_bytes(roles, role_mesh(scaled_parts(model.model, model.scale)))


if __name__ == "__main__":
    with job(snakemake.log):
        prepare_kind(
            snakemake.wildcards.object,
            Resolution.check(snakemake.params.settings),
            Path(snakemake.output.properties).parent,
            snakemake.output.roles,
        )
