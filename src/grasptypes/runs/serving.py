"""The predictors for MLflow serving: images and tasks in, grasp types out."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
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
from grasptypes.predictors.shown import Hints, Shown, look
from grasptypes.predictors.weights import weights_file
from grasptypes.renders.photos import Box, padded
from grasptypes.settings.params import read_params

# `predict.photos.min_px` of params.yaml, which is not stored with the models of Table I.
MIN_PX = 32
# Files that a request to `general` contains as text.
FILES = ("mask", "depth", "intrinsics")
NPY_START = b"\x93NUMPY"


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
                ``size_m`` (N, 3), longest first, ``mass_kg`` (N,), 0 where unknown, ``box``
                (N, 4), the part that shows the object, 0 for the whole image, ``mask`` (N,), an
                image file, and ``depth`` (N,), a PNG or NPY file, in base64, and ``intrinsics``
                (N,), JSON; each empty where there is none.

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
    files = [np.asarray(told[name]).astype(str).reshape(-1) for name in FILES]
    if {len(pictures)} != set(map(len, (sizes, masses, boxes, *files))):
        names = ", ".join(["size_m", "mass_kg", "box", *FILES])
        raise _refusal(f"{len(pictures)} images need as many of each: {names}")
    answers = []
    for number, (picture, task, mass) in enumerate(zip(pictures, tasks, masses, strict=True)):
        left, top, right, bottom = boxes[number].tolist()
        box = (left, top, right, bottom) if boxes[number].any() else None
        texts = {name: str(texts[number]) for name, texts in zip(FILES, files, strict=True)}
        shown = _seen(picture, box, texts, predictor)
        known = sizes[number][sizes[number] != 0].tolist()
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


def _seen(
    picture: np.ndarray, box: Box | None, texts: Mapping[str, str], predictor: Predictor
) -> Shown:
    """An image with the box, and with the files that a request contains.

    Raises:
        MlflowException: a text is not base64.
        InputError: a file cannot be used.
    """
    with TemporaryDirectory() as folder:
        files = {}
        for name, text in texts.items():
            if not text:
                continue
            try:
                content = text.encode() if name == "intrinsics" else b64decode(text, validate=True)
            except ValueError as error:
                raise _refusal(f"{name}: is not base64 ({error})") from error
            ending = ".npy" if content.startswith(NPY_START) else ""
            files[name] = Path(folder, name + ending)
            files[name].write_bytes(content)
        try:
            mask, depth, intrinsics = (files.get(name) for name in FILES)
            hints = Hints(box=box, mask=mask, depth=depth, intrinsics=intrinsics)
            return look(picture, hints, predictor.params)
        except InputError as error:
            raise _refusal(str(error).replace(f"{folder}/", "")) from error


def _refusal(message: str) -> MlflowException:
    """An error that the server answers with status 400, without a stack trace."""
    return MlflowException(message, INVALID_PARAMETER_VALUE)


mlflow.models.set_model(GraspTypePredictor())
