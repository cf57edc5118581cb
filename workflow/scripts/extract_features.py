"""Extract an object's frozen features in every encoding of the task; one job per object."""

from collections.abc import Mapping
from pathlib import Path

import torch

from grasptypes.files import write_npz
from grasptypes.jobs import job
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.features import encodings, extract
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.renders.archives import read_pictures
from grasptypes.settings.predictors import FeatureSettings


def extract_features(
    pictures: str | Path,
    record: str | Path,
    target: str | Path,
    tasks: Mapping[str, int],
    settings: FeatureSettings,
) -> None:
    """Write one array per encoding, (views, F) float32, to `target`."""
    known = BackboneRecord.read(record)
    backbone = load_backbone(known.find_weights(), known.input_px)
    shifts = encodings(tasks)
    features = extract(backbone, read_pictures(pictures), shifts, settings.batch)
    write_npz(target, features)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        extract_features(
            snakemake.input.pictures,
            snakemake.input.backbone,
            snakemake.output.features,
            snakemake.params.tasks,
            FeatureSettings.check(snakemake.params.settings),
        )
