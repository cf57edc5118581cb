"""Features and class scores of photographs of objects with names."""

from pathlib import Path

import torch

from grasptypes.jobs import job
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.general_backbone import describe, weights_of
from grasptypes.predictors.general_files import write_pictures
from grasptypes.predictors.photographs import read_photographs, shown_objects
from grasptypes.settings.commands import PhotoLimits
from grasptypes.settings.predictors import BackboneSettings

if __name__ == "__main__":
    with job(snakemake.log) as log:
        torch.set_num_threads(snakemake.threads)
        params = snakemake.params
        settings = BackboneSettings.check(params.settings)
        (path,) = params.table
        table = read_photographs(path, params.objects)
        shown = shown_objects(table, Path(path).parent, PhotoLimits.check(params.limits))
        weights = weights_of(params.backbone, settings.timeout_s)
        backbone = load_backbone(weights, settings.input_px)
        write_pictures(snakemake.output.features, describe(backbone, weights, shown, params.batch))
        log.info("%d photographs of %d objects", len(table), table["object"].nunique())
