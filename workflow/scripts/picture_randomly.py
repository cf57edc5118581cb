"""Images of an object in which everything else is random; one job per object."""

from pathlib import Path

from tqdm import tqdm

from grasptypes.files import write_bytes, zip_bytes
from grasptypes.jobs import job
from grasptypes.renders.randomisation import random_pictures
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import load_parts
from grasptypes.settings.general import ImageSettings
from grasptypes.settings.renders import CameraSettings


def picture_randomly(
    visual: str | Path,
    target: str | Path,
    draws: tuple[str, int],
    camera: CameraSettings,
    settings: ImageSettings,
) -> None:
    """Write an archive of the images of an object.

    Args:
        draws: object name and seed, which determine the images.
    """
    name, seed = draws
    with Camera(camera) as used:
        taken = random_pictures(used, load_parts(visual), name, seed, settings)
        shown = tqdm(taken, name, total=settings.views, mininterval=5)
        members = {f"{number:03d}.jpg": jpeg for number, jpeg in enumerate(shown)}
    write_bytes(target, zip_bytes(members))


if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        picture_randomly(
            snakemake.input.visual,
            snakemake.output.pictures,
            (snakemake.wildcards.object, params.seed),
            CameraSettings.check(params.camera),
            ImageSettings.check(params.settings),
        )
