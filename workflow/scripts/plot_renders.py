"""Show some renders of every object on one sheet."""

from collections.abc import Mapping

import numpy as np

from grasptypes.files import write_bytes
from grasptypes.jobs import job
from grasptypes.renders.archives import read_pictures
from grasptypes.renders.renderer import png_bytes
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.settings.renders import RenderSheet


def plot_renders(
    archives: Mapping[str, str], target: str, settings: RenderSheet, compression: int
) -> None:
    """Write a sheet of the first images in each object's archive."""
    tiles = [
        Tile(np.hstack(list(read_pictures(path)[: settings.views])), name)
        for name, path in archives.items()
    ]
    whole = sheet([Group("", tiles)], settings.columns, settings.tile_px)
    write_bytes(target, png_bytes(whole, compression))


if __name__ == "__main__":
    with job(snakemake.log):
        plot_renders(
            dict(zip(snakemake.params.objects, snakemake.input.pictures, strict=True)),
            snakemake.output.sheet,
            RenderSheet.check(snakemake.params.sheet),
            snakemake.params.compression,
        )
