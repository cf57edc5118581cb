"""Render every grasp of an object, named as in the dataset's Image column."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from grasptypes.files import write_bytes, zip_bytes
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.renders.contact_pictures import plain
from grasptypes.renders.gallery import grasp_picture, state_of
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.renders.scene import load_parts
from grasptypes.settings.renders import CameraSettings, GallerySettings
from grasptypes.synthesis.grasps import GRASP_SCHEMA
from grasptypes.tables import read_table


def picture_grasps(
    hand: Hand,
    name: str,
    tables: Mapping[str, str | Path],
    visual: str | Path,
    target: str | Path,
    renders: CameraSettings,
    settings: GallerySettings,
) -> None:
    """Write `<object>_<session>_<task>.png` of each grasp, valid or not, to one archive.

    Args:
        tables: the grasps of the object `name`, by task.
    """
    plainly = plain(renders, settings.screenshot_px)
    parts = load_parts(visual)
    members = {}
    with Camera(plainly) as camera:
        for task, path in tables.items():
            for row in read_table(path, GRASP_SCHEMA).itertuples():
                picture = grasp_picture(parts, state_of(hand, row), camera, settings.elevation_rad)
                file_name = f"{name}_{row.session}_{task}.png"
                members[file_name] = png_bytes(picture, plainly.png_compression)
    write_bytes(target, zip_bytes(members))


if __name__ == "__main__":
    with job(snakemake.log):
        tasks: Sequence[str] = snakemake.params.tasks
        picture_grasps(
            load_hand(snakemake.params.hand["name"]),
            snakemake.wildcards.object,
            dict(zip(tasks, snakemake.input.grasps, strict=True)),
            snakemake.input.visual,
            snakemake.output.pictures,
            CameraSettings.check(snakemake.params.renders),
            GallerySettings.check(snakemake.params.settings),
        )
