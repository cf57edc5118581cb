"""Draw examples of rejected grasps, one row per reason."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from grasptypes.files import write_bytes
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.renders.contact_pictures import plain
from grasptypes.renders.gallery import grasp_picture, state_of
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.renders.scene import load_parts
from grasptypes.reports.rejections import caption, examples, heading
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.settings.renders import CameraSettings, GallerySettings
from grasptypes.synthesis.grasps import ATTEMPT_SCHEMA
from grasptypes.tables import read_table


def plot_rejected_grasps(
    hand: Hand,
    tables: Sequence[str | Path],
    visuals: Mapping[str, str | Path],
    target: str | Path,
    renders: CameraSettings,
    settings: GallerySettings,
) -> None:
    """Draw some rejected attempts of `tables` for each reason."""
    attempts = pd.concat([read_table(path, ATTEMPT_SCHEMA) for path in tables], ignore_index=True)
    plainly = plain(renders, settings.size_px)
    groups = [] if not attempts.valid.all() else [Group("no attempt was rejected", [])]
    with Camera(plainly) as camera:
        for reason, rows in examples(attempts, settings.rejected).groupby("reason", sort=False):
            tiles = [
                Tile(
                    grasp_picture(
                        load_parts(visuals[row.object]),
                        state_of(hand, row),
                        camera,
                        settings.elevation_rad,
                    ),
                    caption(row),
                )
                for row in rows.itertuples()
            ]
            groups.append(Group(heading(attempts, str(reason)), tiles))
    whole = sheet(groups, settings.rejected, settings.tile_px)
    write_bytes(target, png_bytes(whole, plainly.png_compression))


if __name__ == "__main__":
    with job(snakemake.log):
        plot_rejected_grasps(
            load_hand(snakemake.params.hand["name"]),
            snakemake.input.attempts,
            dict(zip(snakemake.params.objects, snakemake.input.visuals, strict=True)),
            snakemake.output.sheet,
            CameraSettings.check(snakemake.params.renders),
            GallerySettings.check(snakemake.params.settings),
        )
