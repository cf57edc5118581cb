"""Asking a trained predictor about new pictures, and what it answers."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.special import expit, softmax

from grasptypes.errors import InputError
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.predictors.metrics import SIGMOID_THRESHOLD
from grasptypes.predictors.predictor import VARIANTS
from grasptypes.predictors.predictor_files import (
    ModelCard,
    PredictorNetwork,
    load_predictor,
    read_card,
)
from grasptypes.predictors.weights import find_weights
from grasptypes.renders.mesh_views import mesh_views, views
from grasptypes.renders.photos import read_photo
from grasptypes.settings.objects import OwnObject
from grasptypes.settings.params import Params, read_params

# What a model may have been trained on; its folder below models/.
LABELS = ("simulated", "published")
MODEL_OF_ROW = {variant.row: name for name, variant in VARIANTS.items()}


class Answer(NamedTuple):
    """What a predictor says of one picture, or of several views of one object together."""

    name: str
    probability: np.ndarray
    """(types,) softmax; sums to one."""
    sigmoid: np.ndarray
    """(types,) how sure it is of each type by itself."""

    @property
    def chosen(self) -> np.ndarray:
        """(types,) whether a type is chosen (paper, section IV-B)."""
        return self.sigmoid > SIGMOID_THRESHOLD


def predictor_paths(root: str | Path, labels: str, model: str) -> tuple[Path, Path]:
    """Tensors and card of a trained model.

    Args:
        model: its name, or the letter of its row in Table I.

    Raises:
        InputError: there is no such model, or it is not trained.
    """
    name = MODEL_OF_ROW.get(model, model)
    if name not in VARIANTS:
        allowed = ", ".join(f"{row} ({name})" for row, name in MODEL_OF_ROW.items())
        raise InputError("--model", model, f"unknown; allowed: {allowed}")
    if labels not in LABELS:
        raise InputError("--labels", labels, f"unknown; allowed: {', '.join(LABELS)}")
    folder = Path("models", labels, name)
    paths = tuple(Path(root) / folder / f"predictor.{end}" for end in ("safetensors", "json"))
    for path in paths:
        if not path.is_file():
            command = f"snakemake -j2 {folder}/predictor.json"
            raise InputError(path, "", f"is not trained yet; run: {command} (or: dvc pull models)")
    return paths[0], paths[1]


class Predictor:
    """A trained model of a checkout, which answers which grasp types suit an object and a task.

    Args:
        params: the checkout's: how meshes are rendered, and which photos are accepted.
    """

    def __init__(self, model: PredictorNetwork, params: Params) -> None:
        self.model = model
        self.params = params

    @classmethod
    def load(
        cls, folder: str | Path = ".", *, labels: str | None = None, model: str | None = None
    ) -> Predictor:
        """The model with the backbone's weights of this machine; no host is asked.

        Args:
            folder: a checkout, whose parameters and models are used.
            labels: source of the labels it was trained on; by default that of the parameters.
            model: its name or the letter of its row in Table I; by default that of the parameters.

        Raises:
            InputError: it is not trained, or the weights here are not those it was trained with.
        """
        params = read_params(Path(folder) / "params.yaml")
        chosen = labels or params.predict.labels, model or params.predict.model
        tensors, card = predictor_paths(folder, *chosen)
        read_card(card)  # a damaged card is told before missing weights
        return cls(load_predictor(tensors, card, find_weights(timeout_s=0)), params)

    @property
    def card(self) -> ModelCard:
        """What the model is, and what it knows."""
        return self.model.card

    def predict(
        self,
        shown: ObjectGeometry | np.ndarray | str | Path,
        task: str | None = None,
        *,
        name: str = "",
    ) -> Answer:
        """The grasp types for what is shown.

        Args:
            shown: an object, which is rendered from around; the file of a photo; or images
                (H, W, 3) or (N, H, W, 3) uint8 of one object, whose answers are averaged.
            task: what the object is grasped for; models that do not see the task need none.
            name: of the answer.

        Raises:
            InputError: an unknown task, or a photo that cannot be used.
        """
        task = check_task(self.card, task)
        logits = self.model.logits(self.images(shown), task)
        return Answer(name, softmax(logits, axis=-1).mean(axis=0), expit(logits).mean(axis=0))

    def images(self, shown: ObjectGeometry | np.ndarray | str | Path) -> np.ndarray:
        """What the model sees of it: (N, H, W, 3) uint8."""
        if isinstance(shown, ObjectGeometry):
            return views(shown.visual, self.params.renders, self.params.predict.views)
        if isinstance(shown, str | Path):
            return read_photo(shown, self.params.predict.photos)[None]
        return shown[None] if shown.ndim == 3 else shown

    def mesh_images(self, own: OwnObject) -> np.ndarray:
        """As `images`, of a user's mesh that need not be prepared for planning."""
        return mesh_views(own, self.params)

    def describe(self, answers: Sequence[Answer], task: str | None) -> dict[str, Any]:
        """Everything there is to say, as plain values for JSON."""
        return describe(answers, self.card, check_task(self.card, task))


def check_task(card: ModelCard, task: str | None) -> str:
    """The task to ask for; models that do not see the task need none.

    Raises:
        InputError: none given where one is needed, or an unknown one.
    """
    if task is None and not sees_task(card):
        return card.tasks[0]
    if task not in card.tasks:
        said = "is needed" if task is None else "unknown"
        raise InputError("--task", task or "", f"{said}; allowed: {', '.join(card.tasks)}")
    return task


def sees_task(card: ModelCard) -> bool:
    """Whether the answer depends on the task."""
    variant = VARIANTS[card.model]
    return variant.picture_shows_task or variant.task_vector


def wanted_types(answer: Answer, types: Sequence[str]) -> list[str]:
    """The chosen types as the published table spells them; the likeliest if none is chosen."""
    likeliest = answer.probability == answer.probability.max()
    chosen = answer.chosen if answer.chosen.any() else likeliest
    return [spelled(kind) for kind, yes in zip(types, chosen, strict=True) if yes]


def describe(answers: Sequence[Answer], card: ModelCard, task: str) -> dict[str, Any]:
    """Everything there is to say, as plain values for JSON."""
    return {
        "model": card.model,
        "labels": card.labels,
        "task": task if sees_task(card) else None,
        "backbone": card.backbone,
        "weights": card.weights,
        "finetune": card.finetune,
        "answers": [
            {
                "name": answer.name,
                "probability": _by_type(card, answer.probability),
                "sigmoid": _by_type(card, answer.sigmoid),
                "chosen": [t for t, yes in zip(card.types, answer.chosen, strict=True) if yes],
            }
            for answer in answers
        ],
    }


def report(answers: Sequence[Answer], card: ModelCard, task: str) -> str:
    """The same for people: a block for one answer, a row each for several."""
    asked = f"task {task}" if sees_task(card) else "whatever the task"
    lines = [
        f"model     {card.model}, {card.labels} labels, {asked}",
        f"backbone  {card.backbone}, {card.weights}",
        "",
    ]
    block = _block if len(answers) == 1 else _rows
    return "\n".join([*lines, *block(answers, card)]) + "\n"


def _block(answers: Sequence[Answer], card: ModelCard) -> list[str]:
    (answer,) = answers
    rows = zip(card.types, answer.probability, answer.sigmoid, answer.chosen, strict=True)
    head = f"{'':18}probability  sigmoid"
    return [answer.name, head] + [
        f"{spelled(kind):18}{probability:11.3f}  {alone:7.3f}{'  chosen' if yes else ''}"
        for kind, probability, alone, yes in rows
    ]


def _rows(answers: Sequence[Answer], card: ModelCard) -> list[str]:
    width = max(len(answer.name) for answer in answers)
    kinds = [spelled(kind) for kind in card.types]
    lines = ["  ".join([" " * width, *kinds, "chosen"])]
    for answer in answers:
        cells = [f"{p:{len(kind)}.3f}" for kind, p in zip(kinds, answer.probability, strict=True)]
        chosen = [kind for kind, yes in zip(kinds, answer.chosen, strict=True) if yes]
        lines.append("  ".join([f"{answer.name:{width}}", *cells, ", ".join(chosen) or "none"]))
    return lines


def spelled(kind: str) -> str:
    """As the published table spells a type."""
    return kind.replace("_", " ").title()


def _by_type(card: ModelCard, values: np.ndarray) -> dict[str, float]:
    return {kind: float(value) for kind, value in zip(card.types, values, strict=True)}
