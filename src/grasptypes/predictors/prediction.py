"""Predictions of a trained model for new images."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from grasptypes.errors import InputError
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.predictors.general_predictor import (
    GENERAL,
    GeneralCard,
    GeneralNetwork,
    load_general,
)
from grasptypes.predictors.known_size import facts_of_size
from grasptypes.predictors.metrics import SIGMOID_THRESHOLD
from grasptypes.predictors.predictor import VARIANTS
from grasptypes.predictors.predictor_files import (
    ModelCard,
    PredictorNetwork,
    load_predictor,
)
from grasptypes.predictors.weights import find_weights
from grasptypes.renders.mesh_views import mesh_views, views
from grasptypes.renders.photos import read_photo
from grasptypes.settings.objects import OwnObject
from grasptypes.settings.params import PARAMS, Params, checkout_params

# Label sources of trained models; their folders below models/.
LABELS = ("simulated", "published")
MODEL_OF_ROW = {variant.row: name for name, variant in VARIANTS.items()}
Network = PredictorNetwork | GeneralNetwork
Card = ModelCard | GeneralCard


@dataclass(frozen=True)
class Answer:
    """Prediction for one image, or for several views of one object together.

    Attributes:
        name: name of the image or object.
        types: (K) grasp types, spelled as in model cards.
        probability: (K,) share of each type; sums to one.
        sigmoid: (K,) probability that each type occurs, on its own.
    """

    name: str
    types: Sequence[str]
    probability: np.ndarray
    sigmoid: np.ndarray

    @property
    def chosen(self) -> np.ndarray:
        """(K,) whether a type is chosen (paper, section IV-B)."""
        return self.sigmoid > SIGMOID_THRESHOLD

    @property
    def grasp_types(self) -> list[str]:
        """The chosen types, spelled as in `GRASP_TYPES`; the likeliest if none is chosen."""
        likeliest = self.probability == self.probability.max()
        found = self.chosen if self.chosen.any() else likeliest
        return [spelled(kind) for kind, yes in zip(self.types, found, strict=True) if yes]


def predictor_paths(root: str | Path, labels: str, model: str) -> tuple[Path, Path]:
    """Tensors and card of a trained model.

    Args:
        model: name, or letter of its row in Table I.

    Raises:
        InputError: the model does not exist, or is not trained.
    """
    name = MODEL_OF_ROW.get(model, model)
    if name not in VARIANTS:
        rows = (f"{row} ({name})" for row, name in MODEL_OF_ROW.items())
        allowed = ", ".join([GENERAL, *rows])
        raise InputError("--model", model, f"unknown; allowed: {allowed}")
    if labels not in LABELS:
        raise InputError("--labels", labels, f"unknown; allowed: {', '.join(LABELS)}")
    folder = Path("models", labels, name)
    tensors, card = (Path(root, folder, f"predictor.{end}") for end in ("safetensors", "json"))
    for path in (tensors, card):
        if not path.is_file():
            if not Path(root, PARAMS).is_file():
                said = "there is no trained model here; name a checkout with one (--folder)"
                raise InputError(path, "", said)
            command = f"snakemake -j2 {folder}/predictor.json"
            raise InputError(path, "", f"is not trained yet; run: {command} (or: dvc pull models)")
    return tensors, card


def load_model(root: str | Path, labels: str, model: str) -> Network:
    """A trained model with the backbone's weights on this machine, see `predictor_paths`.

    The predictor for unseen objects comes with the package, whatever the root and the labels.
    """
    if model == GENERAL:
        return load_general()
    tensors, card = predictor_paths(root, labels, model)
    ModelCard.read(card)  # report a damaged card before missing weights
    return load_predictor(tensors, card, find_weights(timeout_s=0))


class Predictor:
    """A trained model, which predicts the grasp types for an object and a task.

    Args:
        params: parameters of the checkout: how meshes are rendered, which photos are accepted.
    """

    def __init__(self, model: Network, params: Params) -> None:
        self.model = model
        self.params = params

    @classmethod
    def load(
        cls,
        folder: str | Path | None = None,
        *,
        labels: str | None = None,
        model: str | None = None,
        params: Params | None = None,
    ) -> Predictor:
        """Load the model, with the backbone's weights on this machine; without network access.

        Args:
            folder: checkout with the parameters and models; default: the current folder.
            labels: label source it was trained on; default: from the parameters.
            model: `general`, or a model of Table I by its name or the letter of its row; default:
                from the parameters.
            params: parameters to use instead of the checkout's.

        Raises:
            InputError: the model is not trained, or was trained with other weights.
        """
        import_module("torchvision")  # before OpenGL: see `renders.renderer`
        params = params or checkout_params(folder)
        chosen = labels or params.predict.labels, model or params.predict.model
        return cls(load_model(folder or ".", *chosen), params)

    @property
    def card(self) -> Card:
        """Description of the model."""
        return self.model.card

    def predict(
        self,
        shown: ObjectGeometry | np.ndarray | str | Path,
        task: str | None = None,
        *,
        name: str = "",
        background: tuple[int, int, int] | None = None,
        size_m: Sequence[float] = (),
        mass_kg: float | None = None,
    ) -> Answer:
        """Predict grasp types.

        Args:
            shown: an object, which is rendered from several sides; a photo file; or images
                (H, W, 3) or (N, H, W, 3) uint8 of one object, whose predictions are averaged.
            task: the task; not needed for models that do not see it.
            name: name of the answer.
            background: RGB colour behind a photo's transparent pixels.
            size_m: longest extent of the object, or all three, if known; those of an object with
                geometry are known. Only the model `general` uses size and mass.
            mass_kg: mass of the object, if known.

        Raises:
            InputError: an unknown task, an unusable photo, or a size or mass out of range.
        """
        if isinstance(shown, ObjectGeometry) and not size_m:
            size_m = np.ptp(shown.properties.bounds_m, axis=0).tolist()
        facts = facts_of_size(size_m, mass_kg, self.params.predict)
        pictures, task = self.images(shown, background), self.check_task(task)
        shares, occurs = self.model.answers(pictures, task, facts)
        return Answer(name, self.card.types, shares.mean(axis=0), occurs.mean(axis=0))

    def images(
        self,
        shown: ObjectGeometry | np.ndarray | str | Path,
        background: tuple[int, int, int] | None = None,
    ) -> np.ndarray:
        """Images that the model sees: (N, H, W, 3) uint8; see `predict`."""
        if isinstance(shown, ObjectGeometry):
            return views(shown.visual, self.params.renders, self.params.predict.views)
        if isinstance(shown, str | Path):
            return read_photo(shown, self.params.predict.photos, background)[None]
        return shown[None] if shown.ndim == 3 else shown

    def mesh_images(self, own: OwnObject) -> tuple[np.ndarray, list[float]]:
        """Like `images`, for a user's mesh that is not prepared for planning, and its extents."""
        return mesh_views(own, self.params)

    def check_task(self, task: str | None) -> str:
        """The checked task; models that do not see the task need none.

        Raises:
            InputError: the task is missing or unknown.
        """
        known = self.card.tasks
        if task is None and not self.card.sees_task:
            return known[0]
        if task not in known:
            said = "is needed" if task is None else "unknown"
            raise InputError("--task", task or "", f"{said}; allowed: {', '.join(known)}")
        return task

    def describe(self, answers: Sequence[Answer], task: str | None) -> dict[str, Any]:
        """The complete answers for a task, as plain values for JSON."""
        card = self.card
        return {
            "model": card.model,
            "labels": card.labels,
            "task": self.check_task(task) if card.sees_task else None,
            "backbone": card.backbone,
            "weights": card.weights,
            "finetune": card.finetune,
            "answers": [
                {
                    "name": answer.name,
                    "probability": dict(zip(card.types, answer.probability.tolist(), strict=True)),
                    "sigmoid": dict(zip(card.types, answer.sigmoid.tolist(), strict=True)),
                    "chosen": [t for t, yes in zip(card.types, answer.chosen, strict=True) if yes],
                }
                for answer in answers
            ],
        }


def report(answers: Sequence[Answer], card: Card, task: str) -> str:
    """Answers as text: a block for one, one row each for several."""
    whose = f"task {task}" if card.sees_task else "whatever the task"
    if task not in card.learned:
        whose += ", which it has not learned"
    lines = [
        f"model     {card.model}, {card.labels} labels, {whose}",
        f"backbone  {card.backbone}, {card.weights}",
        "",
    ]
    block = _block(answers[0]) if len(answers) == 1 else _rows(answers)
    return "\n".join([*lines, *block]) + "\n"


def _block(answer: Answer) -> list[str]:
    rows = zip(answer.types, answer.probability, answer.sigmoid, answer.chosen, strict=True)
    return [answer.name, f"{'':18}probability  sigmoid"] + [
        f"{spelled(kind):18}{probability:11.3f}  {alone:7.3f}{'  chosen' if yes else ''}"
        for kind, probability, alone, yes in rows
    ]


def _rows(answers: Sequence[Answer]) -> list[str]:
    width = max(len(answer.name) for answer in answers)
    kinds = [spelled(kind) for kind in answers[0].types]
    lines = ["  ".join([" " * width, *kinds, "chosen"])]
    for answer in answers:
        cells = [f"{p:{len(kind)}.3f}" for kind, p in zip(kinds, answer.probability, strict=True)]
        chosen = [kind for kind, yes in zip(kinds, answer.chosen, strict=True) if yes]
        lines.append("  ".join([f"{answer.name:{width}}", *cells, ", ".join(chosen) or "none"]))
    return lines


def spelled(kind: str) -> str:
    """A type as spelled in the published table."""
    return kind.replace("_", " ").title()
