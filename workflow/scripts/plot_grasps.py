"""Draw the best grasp of every object and task on one sheet."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from grasptypes.files import write_bytes
from grasptypes.jobs import job
from grasptypes.renders.contact_pictures import studio_of
from grasptypes.renders.gallery import best_grasp, grasp_picture, pose_of
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.renders.scene import load_parts
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.synthesis.grasps import GRASP_SCHEMA
from grasptypes.tables import read_table


def plot_grasps(
    names: Sequence[tuple[str, str]],
    tables: Sequence[str | Path],
    visuals: Mapping[str, str | Path],
    target: str | Path,
    renders: Mapping[str, Any],
    params: Mapping[str, Any],
) -> None:
    """Draw one grasp of each (object, task) of `names`, whose tables come in the same order."""
    tiles = []
    studio = studio_of(renders, params["size_px"])
    with Camera(studio) as camera:
        for (name, task), path in zip(names, tables, strict=True):
            best = best_grasp(read_table(path, GRASP_SCHEMA))
            if best is not None:
                parts = load_parts(visuals[name])
                picture = grasp_picture(parts, *pose_of(best), camera, params["elevation_rad"])
                tiles.append(Tile(picture, f"{name}, {task}"))
    whole = sheet([Group("", tiles)], params["columns"], params["tile_px"])
    write_bytes(target, png_bytes(whole, studio.png_compression))


if __name__ == "__main__":
    with job(snakemake.log):
        plot_grasps(
            [tuple(name) for name in snakemake.params.names],
            snakemake.input.grasps,
            dict(zip(snakemake.params.objects, snakemake.input.visuals, strict=True)),
            snakemake.output.sheet,
            snakemake.params.renders,
            snakemake.params.settings,
        )
