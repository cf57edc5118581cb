"""A learning problem read from files: examples, training settings, and backbone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from grasptypes.labels.samples import TYPES, read_samples
from grasptypes.predictors.backbone import Backbone, load_backbone
from grasptypes.predictors.examples import Examples, assemble
from grasptypes.predictors.features import read_inputs
from grasptypes.predictors.folds import FOLD_SCHEMA
from grasptypes.predictors.predictor import Architecture
from grasptypes.predictors.predictor_files import ModelCard
from grasptypes.predictors.variants import VARIANTS
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.tables import read_table


@dataclass(frozen=True)
class LearningProblem:
    """Training data and settings of one model and label source.

    Attributes:
        labels: the label source.
        model: name of the variant.
        tasks: colour shift of each task, in the order of the task vector.
        examples: with features as inputs if the backbone is frozen, else with images.
        settings: training settings.
        record: record of the backbone.
        backbone: backbone to fine-tune; None if it is frozen.
    """

    labels: str
    model: str
    tasks: Mapping[str, int]
    examples: Examples
    settings: PredictorSettings
    record: BackboneRecord
    backbone: Backbone | None

    def card(self, architecture: Architecture) -> ModelCard:
        """The card of a predictor trained on this problem."""
        return ModelCard(
            model=self.model,
            labels=self.labels,
            types=TYPES,
            tasks=tuple(self.tasks),
            colour_shifts=dict(self.tasks),
            architecture=architecture,
            backbone=self.record.backbone,
            weights=self.record.weights,
            input_px=self.record.input_px,
            finetune=self.settings.finetune,
        )


def read_problem(
    files: Mapping[str, Any],
    name: tuple[str, str],
    tasks: Mapping[str, int],
    settings: PredictorSettings,
) -> LearningProblem:
    """Read the problem of a label source and model.

    Args:
        files: ``inputs`` (features or images, one file per object), ``samples``, ``folds`` and
            ``backbone`` (its record).
        name: label source and model.
        tasks: colour shift of each task, in the order of the task vector.

    Raises:
        InputError: a file is damaged or inconsistent with the others.
    """
    labels, model = name
    record = BackboneRecord.read(files["backbone"])
    inputs, folds = read_inputs(files["inputs"], tasks), read_table(files["folds"], FOLD_SCHEMA)
    # Not every label source has labels for every object in the folds.
    folds = folds[folds["object"].isin(inputs)]
    examples = assemble(VARIANTS[model], inputs, read_samples(files["samples"]), folds, list(tasks))
    backbone = None if settings.frozen else load_backbone(record.find_weights(), record.input_px)
    return LearningProblem(labels, model, tasks, examples, settings, record, backbone)
