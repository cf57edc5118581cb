"""Features and class scores of all images of a group of objects, in one file."""

from collections.abc import Sequence
from pathlib import Path

import torch

from grasptypes.jobs import job
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.general_backbone import describe, weights_of
from grasptypes.predictors.general_files import write_pictures
from grasptypes.renders.archives import read_pictures
from grasptypes.settings.predictors import BackboneSettings


def describe_pictures(
    archives: Sequence[str],
    target: str | Path,
    name: str,
    settings: BackboneSettings,
    batch: int,
) -> str:
    """Write the numbers of all images of the archives, which are named after their objects.

    Returns a line for the log.
    """
    weights = weights_of(name, settings.timeout_s)
    backbone = load_backbone(weights, settings.input_px)
    shown = ((Path(path).stem, read_pictures(path)) for path in archives)
    pictures = describe(backbone, weights, shown, batch)
    write_pictures(target, pictures)
    return f"{len(pictures.objects)} images, {name}, weights {weights.name}"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        torch.set_num_threads(snakemake.threads)
        params = snakemake.params
        log.info(
            describe_pictures(
                snakemake.input.pictures,
                snakemake.output.features,
                params.backbone,
                BackboneSettings.check(params.settings),
                params.batch,
            )
        )
