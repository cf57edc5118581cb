"""The predictor for MLflow serving: images and tasks in, probabilities out."""

from __future__ import annotations

from pathlib import Path

import mlflow
import numpy as np
from mlflow.exceptions import MlflowException
from mlflow.protos.databricks_pb2 import INVALID_PARAMETER_VALUE
from mlflow.pyfunc.model import PythonModel, PythonModelContext

from grasptypes.errors import InputError
from grasptypes.predictors.predictor_files import ModelCard, load_predictor
from grasptypes.predictors.weights import weights_file
from grasptypes.renders.photos import padded

# `predict.photos.min_px` of params.yaml, which is not stored with the model.
MIN_PX = 32


class GraspTypePredictor(PythonModel):
    """The pyfunc model; its artifacts are ``tensors``, ``card`` and ``weights``."""

    def load_context(self, context: PythonModelContext) -> None:
        """Read the predictor from the artifacts."""
        artifacts = {name: Path(path) for name, path in context.artifacts.items()}
        backbone = ModelCard.read(artifacts["card"]).backbone
        weights = weights_file(backbone, "model", artifacts["weights"])
        self._predictor = load_predictor(artifacts["tensors"], artifacts["card"], weights)

    def predict(self, context, model_input, params=None):  # type: ignore[no-untyped-def]
        """Softmax and sigmoid of each image's logits; images are padded to squares.

        There are no type hints, because MLflow would interpret them as a schema.

        Args:
            model_input: ``image`` (N, H, W, 3) uint8 and ``task`` (N,) names.

        Returns:
            ``probability`` and ``sigmoid``, (N, types) float32 each.

        Raises:
            MlflowException: the request is invalid.
        """
        pictures = np.asarray(model_input["image"], dtype=np.uint8)
        tasks = np.asarray(model_input["task"]).astype(str).reshape(-1)
        outputs = len(self._predictor.card.types)
        probability = np.zeros((len(pictures), outputs), dtype=np.float32)
        sigmoid = np.zeros_like(probability)
        if len(tasks) != len(pictures):
            raise _refusal(
                f"{len(pictures)} images, but {len(tasks)} tasks: one task per image is needed"
            )
        if pictures.ndim != 4 or min(pictures.shape) == 0:
            raise _refusal(f"image has shape {pictures.shape} instead of (N, height, width, 3)")
        if min(pictures.shape[1:3]) < MIN_PX:
            size = f"{pictures.shape[2]} x {pictures.shape[1]}"
            raise _refusal(f"image is {size} pixels; each side needs at least {MIN_PX}")
        # MLflow has already truncated such values to 0 and 1, nearly all of them to 0.
        if pictures.max(axis=(1, 2, 3)).min() <= 1:
            raise _refusal("image has no value above 1: values from 0 to 255 are needed")
        pictures = np.stack([padded(picture) for picture in pictures])
        for task in sorted(set(tasks)):
            try:
                asked = tasks == task
                probability[asked], sigmoid[asked] = self._predictor.answers(pictures[asked], task)
            except InputError as error:
                raise _refusal(str(error)) from error
        return {"probability": probability, "sigmoid": sigmoid}


def _refusal(message: str) -> MlflowException:
    """An error that the server answers with status 400, without a stack trace."""
    return MlflowException(message, INVALID_PARAMETER_VALUE)


mlflow.models.set_model(GraspTypePredictor())
