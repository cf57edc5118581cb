"""Render an object from random viewpoints; one job per object."""

from collections.abc import Mapping
from pathlib import Path

import pandas as pd
import pandera.pandas as pa
from tqdm import tqdm

from grasptypes.files import write_bytes, zip_bytes
from grasptypes.jobs import job
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import load_parts
from grasptypes.settings.renders import CameraSettings
from grasptypes.tables import write_table

POSE = [f"T_object_camera_{row}{column}" for row in range(3) for column in range(4)]
POSE_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "view": pa.Column(int, pa.Check.ge(0)),
        **{name: pa.Column(float) for name in POSE},
    },
    strict=True,
    unique=["object", "view"],
)


def render_object(
    visual: str | Path,
    outputs: Mapping[str, str],
    draws: tuple[str, int, int],
    settings: CameraSettings,
) -> None:
    """Write the images of an object, and the camera pose of each.

    Args:
        draws: object name and seed, which determine the views, and their number.
    """
    name, seed, count = draws
    with Camera(settings) as camera:
        views = camera.views(load_parts(visual), count, name, seed)
        shown = tqdm(views.pngs(), name, total=count, mininterval=5)
        members = {f"{number:03d}.png": png for number, png in enumerate(shown)}
    table = pd.DataFrame(views.T_object_camera[:, :3].reshape(-1, 12), columns=POSE)
    table.insert(0, "object", name)
    table.insert(1, "view", range(len(table)))
    write_bytes(outputs["pictures"], zip_bytes(members))
    write_table(table, outputs["poses"], POSE_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        render_object(
            snakemake.input.visual,
            snakemake.output,
            (snakemake.wildcards.object, params.seed, params.views),
            CameraSettings.check(params.settings),
        )
