"""Train the predictor for unseen objects on all kinds and objects, as it comes with the package."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import torch

from grasptypes.jobs import job
from grasptypes.labels.samples import TYPES
from grasptypes.predictors.general_backbone import weights_of
from grasptypes.predictors.general_files import read_known_kinds, read_known_objects
from grasptypes.predictors.general_predictor import GeneralCard, write_general
from grasptypes.predictors.general_study import final_head, together
from grasptypes.predictors.strangeness import Strangeness
from grasptypes.settings.general import GeneralSettings
from grasptypes.settings.predictors import BackboneSettings


def train_general(
    inputs: Any,
    targets: tuple[str | Path, str | Path],
    settings: tuple[GeneralSettings, BackboneSettings],
    tasks: Sequence[str],
    seed: int,
) -> None:
    """Write the head and its card."""
    general, backbone = settings
    kinds = read_known_kinds(inputs.kinds, inputs.kind_samples, inputs.kind_properties, tasks)
    families = general.protocol.families
    objects = read_known_objects(
        inputs.objects, inputs.simulated, inputs.properties, families, kinds
    )
    head, code = final_head(kinds, objects, general.head)
    known = together(kinds, objects)
    strangeness = Strangeness.of(known.pictures, known.families, general.strangeness, seed)
    weights = weights_of(general.backbone, backbone.timeout_s)
    card = GeneralCard(
        types=TYPES,
        learned=tuple(tasks),
        shapes=len(kinds.facts) + len(objects.facts),
        head=head.settings,
        backbone=weights.backbone,
        weights=weights.name,
        input_px=backbone.input_px,
    )
    write_general(head, code, strangeness, card, targets)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        params = snakemake.params
        settings = GeneralSettings.check(params.settings), BackboneSettings.check(params.backbone)
        targets = snakemake.output.head, snakemake.output.card
        train_general(snakemake.input, targets, settings, params.tasks, params.seed)
