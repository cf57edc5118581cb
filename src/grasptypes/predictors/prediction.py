"""Predictions of a trained model for what a user shows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from grasptypes.errors import InputError
from grasptypes.predictors.answers import Answer, Card, described, spelled
from grasptypes.predictors.batches import in_batches
from grasptypes.predictors.explanation import explain, small
from grasptypes.predictors.general_predictor import GENERAL, GeneralNetwork, load_general
from grasptypes.predictors.known_kinds import nearest
from grasptypes.predictors.known_size import facts_of_size
from grasptypes.predictors.predictor_files import (
    ModelCard,
    PredictorNetwork,
    load_predictor,
)
from grasptypes.predictors.shown import Hints, Photo, Shown, look
from grasptypes.predictors.variants import VARIANTS
from grasptypes.predictors.weights import find_weights
from grasptypes.renders.depth_images import Intrinsics
from grasptypes.renders.photos import Box
from grasptypes.settings.params import PARAMS, Params, checkout_params

if TYPE_CHECKING:
    from grasptypes.objects.object_geometry import ObjectGeometry

# Label sources of trained models; their folders below models/.
LABELS = ("simulated", "published")
MODEL_OF_ROW = {variant.row: name for name, variant in VARIANTS.items()}
Network = PredictorNetwork | GeneralNetwork
__all__ = ["LABELS", "Answer", "Predictor"]
STRANGE = "nothing that was learned looks like this, so the answer is a guess"


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

    It may be used by several threads at a time.

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
        params = params or checkout_params(folder)
        chosen = labels or params.predict.labels, model or params.predict.model
        return cls(load_model(folder or ".", *chosen), params)

    @property
    def card(self) -> Card:
        """Description of the model."""
        return self.model.card

    def predict(
        self,
        shown: ObjectGeometry | Photo | Sequence[Photo],
        task: str | None = None,
        *,
        name: str = "",
        size_m: float | Sequence[float] = (),
        mass_kg: float | None = None,
        unit: str | None = None,
        background: tuple[int, int, int] | None = None,
        box: Box | None = None,
        mask: str | Path | np.ndarray | None = None,
        depth: str | Path | np.ndarray | None = None,
        intrinsics: str | Path | Intrinsics | None = None,
    ) -> Answer:
        """Predict grasp types.

        Args:
            shown: an object, or the file of a mesh (STL, OBJ, PLY, GLB) or of points (PLY, NPY,
                PCD), which are rendered from several sides; an image file; an image (H, W, 3)
                uint8; or several images of one object, whose predictions are averaged.
            task: the task; not needed for models that do not see it.
            name: name of the answer.
            size_m: longest extent of the object, or all three, if known; those of geometry are
                known. Only the model `general` uses size and mass.
            mass_kg: mass of the object, if known.
            unit: of a mesh or of points; default: m.
            background: RGB colour behind an image's transparent pixels.
            box: left, top, right and bottom of the part of an image that shows the object, pixels.
            mask: image file or array (H, W) that is white or true where the object is.
            depth: depth image of the same shape, a file or an array (H, W) in metres: the longest
                extent is measured in it. Needs `intrinsics`, and `mask` or `box`.
            intrinsics: of the camera, a JSON file or an object.

        Raises:
            InputError: an unknown task, an unusable file, or a size or mass out of range.
        """
        self.check_task(task)
        hints = Hints(unit, background, box, mask, depth, intrinsics)
        seen = look(shown, hints, self.params)
        return self.answer([seen], task, names=[name], size_m=size_m, mass_kg=mass_kg)[0]

    def answer(
        self,
        shown: Sequence[Shown],
        task: str | None = None,
        *,
        names: Sequence[str] = (),
        size_m: float | Sequence[float] = (),
        mass_kg: float | None = None,
    ) -> list[Answer]:
        """Predictions for several objects, in batches; see :meth:`predict`.

        Args:
            shown: of `grasptypes.predictors.shown.look`, one per object.
            names: of the answers.
            size_m: of every object whose size was not seen.
            mass_kg: of the same objects.

        Raises:
            InputError: an unknown task, or a size or mass out of range.
        """
        task = self.check_task(task)
        given = tuple(size_m) if isinstance(size_m, Sequence) else (size_m,)
        sizes = [one.size_m or given for one in shown]
        facts = [facts_of_size(size, mass_kg, self.params.predict) for size in sizes]
        pictures = [picture for one in shown for picture in one.pictures]
        ends = np.cumsum([len(one.pictures) for one in shown])[:-1]
        count, network = self.params.predict.batch, self.model
        if isinstance(network, GeneralNetwork):
            (rows,) = in_batches(pictures, count, lambda batch: [network.features(batch)])
            features = np.split(rows, ends)
            told = [network.read(*row, task) for row in zip(features, facts, strict=True)]
        else:
            both = in_batches(pictures, count, lambda batch: network.answers(batch, task))
            told = list(zip(*(np.split(rows, ends) for rows in both), strict=True))
        answers = []
        for number, (one, (shares, occurs)) in enumerate(zip(shown, told, strict=True)):
            name = names[number] if names else ""
            answer = Answer.of(name, self.card.types, shares.mean(axis=0), occurs.mean(axis=0))
            answer = replace(answer, size_m=sizes[number], warnings=one.warnings)
            if isinstance(network, GeneralNetwork):
                answer = self._compared(answer, features[number])
            answers.append(answer)
        return answers

    def _compared(self, answer: Answer, features: np.ndarray) -> Answer:
        """An answer with what is known that looks alike."""
        assert isinstance(self.model, GeneralNetwork)
        memory, count = self.model.head.memory, self.params.predict.known_kinds.shown
        near = nearest(memory, features, count) if memory else ()
        strangeness = float(self.model.strangeness(features).mean())
        warnings = answer.warnings
        if strangeness > 1:
            warnings += (f"{STRANGE} (strangeness {strangeness:.2f})",)
        return replace(answer, neighbours=near, strangeness=strangeness, warnings=warnings)

    def explain(
        self,
        shown: Shown,
        task: str | None = None,
        *,
        size_m: float | Sequence[float] = (),
        mass_kg: float | None = None,
    ) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """What in the first image spoke for each type.

        Returns:
            the image (S, S, 3) uint8 as the backbone sees it, and by the name of each type how far
            its logit falls (S, S) when the surroundings of a pixel are hidden.

        Raises:
            InputError: an unknown task, or a size or mass out of range.
        """
        task = self.check_task(task)
        given = tuple(size_m) if isinstance(size_m, Sequence) else (size_m,)
        facts = facts_of_size(shown.size_m or given, mass_kg, self.params.predict)
        network, count = self.model, self.params.predict.batch

        def see(batch: np.ndarray) -> list[np.ndarray]:
            """Logits (N, types) in a list."""
            if isinstance(network, GeneralNetwork):
                return [network.logits(batch, task, facts)]
            return [network.logits(batch, task)]

        def ask(pictures: Sequence[np.ndarray]) -> np.ndarray:
            """Logits (N, types) of any number of images."""
            return in_batches(pictures, count, see)[0]

        picture = small(shown.pictures[0], self.card.input_px)
        heat = explain(picture, ask, self.params.predict.explanation)
        names = map(spelled, self.card.types)
        return picture, dict(zip(names, heat, strict=True))

    def export(self, path: str | Path) -> None:
        """Write backbone and head together as ONNX: `grasptypes.predictors.onnx_export`.

        Raises:
            InputError: another model than `general`, or the package onnx is missing.
        """
        from grasptypes.predictors.onnx_export import export

        if not isinstance(self.model, GeneralNetwork):
            raise InputError("--model", self.card.model, f"only {GENERAL} can be exported")
        export(self.model, path)

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
        """The complete answers for a task, as plain values for JSON: docs/answer.schema.json."""
        return described(answers, self.card, self.check_task(task)).model_dump(mode="json")
