"""Take pictures of an object from random viewpoints; one job an object."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import pandas as pd
import pandera.pandas as pa
from tqdm import tqdm

from grasptypes.files import write_bytes, zip_bytes
from grasptypes.jobs import job
from grasptypes.renders.renderer import Camera, Studio
from grasptypes.renders.scene import load_parts
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
    pictures: str | Path,
    poses: str | Path,
    name: str,
    seed: int,
    settings: Mapping[str, Any],
) -> None:
    """Write `settings["views"]` pictures of the object `name`, and the camera pose of each."""
    studio = Studio(**{field.name: settings[field.name] for field in fields(Studio)})
    with Camera(studio) as camera:
        views = camera.views(load_parts(visual), settings["views"], name, seed)
        shown = tqdm(views.pngs(), name, total=settings["views"], mininterval=5)
        members = {f"{number:03d}.png": png for number, png in enumerate(shown)}
    table = pd.DataFrame(views.T_object_camera[:, :3].reshape(-1, 12), columns=POSE)
    table.insert(0, "object", name)
    table.insert(1, "view", range(len(table)))
    write_bytes(pictures, zip_bytes(members))
    write_table(table, poses, POSE_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        render_object(
            snakemake.input.visual,
            snakemake.output.pictures,
            snakemake.output.poses,
            snakemake.wildcards.object,
            snakemake.params.seed,
            snakemake.params.settings,
        )
