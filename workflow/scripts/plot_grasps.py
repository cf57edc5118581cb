"""Draw the best grasp of every object and task on one sheet."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from grasptypes.files import write_bytes
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.renders.contact_pictures import plain
from grasptypes.renders.gallery import best_grasp, grasp_picture, state_of
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.renders.scene import load_parts
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.settings.renders import CameraSettings, GallerySettings
from grasptypes.synthesis.grasps import GRASP_SCHEMA
from grasptypes.tables import read_table


def plot_grasps(
    hand: Hand,
    names: Sequence[tuple[str, str]],
    tables: Sequence[str | Path],
    visuals: Mapping[str, str | Path],
    target: str | Path,
    renders: CameraSettings,
    settings: GallerySettings,
) -> None:
    """Draw one grasp for each (object, task) in `names`; tables are in the same order."""
    tiles = []
    plainly = plain(renders, settings.size_px)
    with Camera(plainly) as camera:
        for (name, task), path in zip(names, tables, strict=True):
            best = best_grasp(read_table(path, GRASP_SCHEMA))
            if best is not None:
                parts = load_parts(visuals[name])
                picture = grasp_picture(parts, state_of(hand, best), camera, settings.elevation_rad)
                tiles.append(Tile(picture, f"{name}, {task}"))
    whole = sheet([Group("", tiles)], settings.columns, settings.tile_px)
    write_bytes(target, png_bytes(whole, plainly.png_compression))


if __name__ == "__main__":
    with job(snakemake.log):
        plot_grasps(
            load_hand(snakemake.params.hand["name"]),
            [tuple(name) for name in snakemake.params.names],
            snakemake.input.grasps,
            dict(zip(snakemake.params.objects, snakemake.input.visuals, strict=True)),
            snakemake.output.sheet,
            CameraSettings.check(snakemake.params.renders),
            GallerySettings.check(snakemake.params.settings),
        )
