"""The predictors for MLflow serving: images and tasks in, grasp types out."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mlflow
import numpy as np
from mlflow.exceptions import MlflowException
from mlflow.protos.databricks_pb2 import INVALID_PARAMETER_VALUE
from mlflow.pyfunc.model import PythonModel, PythonModelContext

from grasptypes.errors import InputError
from grasptypes.predictors.answers import spelled
from grasptypes.predictors.general_predictor import CARD, GeneralCard, load_general
from grasptypes.predictors.prediction import Predictor
from grasptypes.predictors.predictor_files import ModelCard, load_predictor
from grasptypes.predictors.shown import Hints, look
from grasptypes.predictors.weights import weights_file
from grasptypes.renders.photos import padded
from grasptypes.settings.params import read_params

# `predict.photos.min_px` of params.yaml, which is not stored with the models of Table I.
MIN_PX = 32


class GraspTypePredictor(PythonModel):
    """The pyfunc model.

    The artifacts of a model of Table I are ``tensors``, ``card`` and ``weights``, those of
    `general` ``trained``, ``params`` and ``weights``.
    """

    def load_context(self, context: PythonModelContext) -> None:
        """Read the predictor from the artifacts."""
        artifacts = {name: Path(path) for name, path in context.artifacts.items()}
        if "trained" in artifacts:
            card = GeneralCard.read(artifacts["trained"] / CARD)
            weights = weights_file(card.backbone, "model", artifacts["weights"])
            params = read_params(artifacts["params"])
            network = load_general(artifacts["trained"], weights=weights)
            self._general: Predictor | None = Predictor(network, params)
            return
        self._general = None
        backbone = ModelCard.read(artifacts["card"]).backbone
        weights = weights_file(backbone, "model", artifacts["weights"])
        self._predictor = load_predictor(artifacts["tensors"], artifacts["card"], weights)

    def predict(self, context, model_input, params=None):  # type: ignore[no-untyped-def]
        """Probability and share of each type; images are padded to squares.

        There are no type hints, because MLflow would interpret them as a schema.

        Args:
            model_input: ``image`` (N, H, W, 3) uint8 and ``task`` (N,) names; of `general` also
                ``size_m`` (N, 3), longest first, ``mass_kg`` (N,), 0 where unknown, and ``box``
                (N, 4), the part that shows the object, 0 for the whole image.

        Returns:
            ``probability`` and ``share``, (N, types) float32 each; of `general` also
            ``strangeness`` (N,) and ``neighbours`` (N, 3) names of kinds.

        Raises:
            MlflowException: the request is invalid.
        """
        pictures = np.asarray(model_input["image"], dtype=np.uint8)
        tasks = np.asarray(model_input["task"]).astype(str).reshape(-1)
        _check_request(pictures, tasks)
        try:
            if self._general:
                return _general_answers(self._general, pictures, tasks, model_input)
            return self._answers(pictures, tasks)
        except InputError as error:
            raise _refusal(str(error)) from error

    def _answers(self, pictures: np.ndarray, tasks: np.ndarray) -> dict[str, np.ndarray]:
        """The answers of a model of Table I."""
        outputs = len(self._predictor.card.types)
        probability = np.zeros((len(pictures), outputs), dtype=np.float32)
        share = np.zeros_like(probability)
        squares = np.stack([padded(picture) for picture in pictures])
        for task in sorted(set(tasks)):
            asked = tasks == task
            share[asked], probability[asked] = self._predictor.answers(squares[asked], task)
        return {"probability": probability, "share": share}


def _check_request(pictures: np.ndarray, tasks: np.ndarray) -> None:
    """Refuse what has no answer."""
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


def _general_answers(
    predictor: Predictor, pictures: np.ndarray, tasks: np.ndarray, told: Mapping[str, Any]
) -> dict[str, np.ndarray]:
    """The answers of `general`, with the types in the order of its card."""
    sizes, masses = np.asarray(told["size_m"], float), np.asarray(told["mass_kg"], float)
    boxes = np.asarray(told["box"], int)
    if not len(sizes) == len(masses) == len(boxes) == len(pictures):
        raise _refusal(f"{len(pictures)} images need as many size_m, mass_kg and box")
    answers = []
    for picture, task, size, mass, box in zip(pictures, tasks, sizes, masses, boxes, strict=True):
        left, top, right, bottom = box.tolist()
        shown = look(
            picture, Hints(box=(left, top, right, bottom) if box.any() else None), predictor.params
        )
        known = size[size != 0].tolist()
        answers += predictor.answer([shown], task, size_m=known, mass_kg=float(mass) or None)
    types = [spelled(name) for name in predictor.card.types]
    rows = [
        ([one.probabilities[name] for name in types], [one.shares[name] for name in types])
        for one in answers
    ]
    probability, share = (np.array(part, dtype=np.float32) for part in zip(*rows, strict=True))
    return {
        "probability": probability,
        "share": share,
        "strangeness": np.array([one.strangeness or 0 for one in answers], dtype=np.float32),
        "neighbours": np.array([[near.name for near in one.neighbours] for one in answers]),
    }


def _refusal(message: str) -> MlflowException:
    """An error that the server answers with status 400, without a stack trace."""
    return MlflowException(message, INVALID_PARAMETER_VALUE)


mlflow.models.set_model(GraspTypePredictor())
