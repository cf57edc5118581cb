"""Render an object that is used and handed over; one job per object."""

from collections.abc import Mapping
from pathlib import Path

from tqdm import tqdm

from grasptypes.files import write_bytes, zip_bytes
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.objects.object_files import read_surface
from grasptypes.renders.demonstrations import Shown, pictures, scenes
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import load_parts
from grasptypes.settings.demonstrations import SceneSettings
from grasptypes.settings.renders import CameraSettings
from grasptypes.synthesis.grasps import GRASP_SCHEMA
from grasptypes.tables import read_table


def demonstrate_tasks(
    shown: Shown,
    tables: Mapping[str, str | Path],
    target: str | Path,
    settings: tuple[SceneSettings, CameraSettings],
    seed: int,
    alone: bool,
) -> None:
    """Write `<number>_<task>.png` of each task and view to one archive.

    Args:
        tables: the grasps by task.
        alone: without the second hand or the bodies that the task needs.
    """
    demonstrations, camera = settings
    members = {}
    with Camera(camera) as used:
        for task, path in tables.items():
            grasps = read_table(path, GRASP_SCHEMA)
            shots_of = scenes(shown, grasps[grasps["valid"]], task, demonstrations, alone)
            key = f"{shown.name} {task}"
            taken = pictures(shots_of, used, (key, seed), demonstrations)
            shots = tqdm(taken, key, total=demonstrations.views, mininterval=5)
            members |= {f"{number:03d}_{task}.png": png for number, png in enumerate(shots)}
    write_bytes(target, zip_bytes(members))


if __name__ == "__main__":
    with job(snakemake.log):
        inputs, params = snakemake.input, snakemake.params
        demonstrate_tasks(
            Shown(
                snakemake.wildcards.object,
                load_parts(inputs.visual),
                read_surface(inputs.surface),
                load_hand(params.hand["name"]),
            ),
            dict(zip(params.tasks, inputs.grasps, strict=True)),
            snakemake.output.pictures,
            (SceneSettings.check(params.settings), CameraSettings.check(params.renders)),
            params.seed,
            params.alone,
        )
