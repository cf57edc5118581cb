"""A small image of each kind that the predictor for unseen objects has learned from."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from grasptypes.jobs import job
from grasptypes.predictors.known_kinds import write_looks
from grasptypes.renders.mesh_views import views
from grasptypes.settings.renders import CameraSettings


def draw_kinds(visuals: Sequence[str], target: str | Path, camera: CameraSettings, px: int) -> None:
    """Write a small image of each object; the folder of its mesh has its name."""
    drawn: dict[str, np.ndarray] = {
        Path(visual).parent.name: views(visual, camera, 1)[0] for visual in visuals
    }
    write_looks(drawn, px, target)


if __name__ == "__main__":
    with job(snakemake.log):
        visuals = [*snakemake.input.visuals, *snakemake.input.object_visuals]
        camera = CameraSettings.check(snakemake.params.camera)
        draw_kinds(visuals, snakemake.output.looks, camera, snakemake.params.picture_px)
