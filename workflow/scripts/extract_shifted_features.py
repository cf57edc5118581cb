"""Extract an object's features with the colours of more tasks than two; one job per object."""

from collections.abc import Mapping
from pathlib import Path

import torch

from grasptypes.files import write_npz
from grasptypes.jobs import job
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.task_inputs import shifted_features
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.renders.archives import read_pictures
from grasptypes.settings.predictors import FeatureSettings


def extract_shifted_features(
    files: Mapping[str, str | Path],
    target: str | Path,
    shifts: Mapping[str, tuple[int, int, int]],
    views: int,
    settings: FeatureSettings,
) -> None:
    """Write one array per task, (views, F) float32, to `target`.

    Args:
        files: `pictures` and the record of the `backbone`.
        shifts: of each task, see :func:`grasptypes.predictors.task_inputs.corner_shifts`.
    """
    record = BackboneRecord.read(files["backbone"])
    backbone = load_backbone(record.find_weights(), record.input_px)
    pictures = read_pictures(files["pictures"])[:views]
    write_npz(target, shifted_features(backbone, pictures, shifts, settings.batch))


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        params = snakemake.params
        extract_shifted_features(
            dict(snakemake.input.items()),
            snakemake.output.features,
            params.shifts,
            params.views,
            FeatureSettings.check(params.settings),
        )
