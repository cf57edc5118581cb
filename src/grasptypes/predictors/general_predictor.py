"""The trained predictor for unseen objects: its file, and its answers about images."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import torch
from scipy.special import logit

from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_npz
from grasptypes.predictors.backbone import Backbone, load_backbone
from grasptypes.predictors.class_scores import CLASSES, class_scores
from grasptypes.predictors.features import for_inference, forward
from grasptypes.predictors.general import GeneralHead
from grasptypes.predictors.general_backbone import weights_of
from grasptypes.predictors.general_inputs import FACTS, Inputs, Projection, TaskCode
from grasptypes.predictors.memory import Memory
from grasptypes.predictors.predictor_files import FROZEN, TrainedRecord
from grasptypes.predictors.strangeness import Strangeness
from grasptypes.predictors.weights import Weights
from grasptypes.settings.base import Many
from grasptypes.settings.general import HeadSettings, MemorySettings
from grasptypes.settings.tasks import read_tasks

GENERAL = "general"
# The head that comes with the package; the rule train_general makes both files again.
TRAINED = Path(__file__).with_name("trained")
HEAD, CARD = "general.npz", "general.json"
# Probabilities are this far from 0 and 1 at least, for logits.
LEAST = 1e-6
REMEMBERED = ("looks", "facts", "tasks", "occurs", "shares")
# In half precision: a thousandth of what tells objects apart.
HALVED = ("memory_looks", "strange_directions")


class GeneralCard(TrainedRecord):
    """Everything needed to use the predictor, apart from the numbers of its head.

    Attributes:
        learned: tasks of its examples.
        shapes: number of objects that it has learned from.
        head: settings of its head.
    """

    model: str = GENERAL
    labels: str = "simulated"
    finetune: str = FROZEN
    learned: Many[str]
    shapes: int
    head: HeadSettings
    sees_task: bool = True

    @property
    def tasks(self) -> tuple[str, ...]:
        """The tasks that it answers for: a task is seen as what it demands."""
        return tuple(read_tasks())


class GeneralNetwork:
    """A backbone, a head and their card: images, task, size and mass to grasp types.

    Args:
        strangeness: whether anything that it has learned looks like an image.
    """

    def __init__(
        self,
        backbone: Backbone,
        weights: Weights,
        head: GeneralHead,
        code: TaskCode,
        card: GeneralCard,
        strangeness: Strangeness,
    ) -> None:
        self.backbone = for_inference(backbone)
        self.weights = weights
        self.head = head
        self.code = code
        self.card = card
        self.strangeness = strangeness

    def answers(
        self, pictures: np.ndarray, task: str, facts: Sequence[float] = ()
    ) -> tuple[np.ndarray, np.ndarray]:
        """Share of each type, and probability that it occurs, (N, types) each.

        Args:
            pictures: (N, H, W, 3) uint8.
            facts: of `general_inputs.FACTS`, NaN where unknown; default: all unknown.
        """
        occurs, shares = self.head.answers(self._inputs(self.features(pictures), facts, task))
        return shares, occurs

    def read(
        self, features: np.ndarray, facts: Sequence[float], task: str
    ) -> tuple[np.ndarray, np.ndarray]:
        """The same (1, types) for features (N, F) of images of one object, taken together."""
        inputs = self._inputs(features, facts, task).together(np.zeros(len(features)))
        occurs, shares = self.head.answers(inputs)
        return shares, occurs

    def _inputs(self, features: np.ndarray, facts: Sequence[float], task: str) -> Inputs:
        """One row per image (N, F)."""
        count = len(features)
        known = np.array(facts or [np.nan] * len(FACTS), dtype=float)
        unused = self.head.classes.directions.shape[1] == 0
        classes = np.zeros((count, CLASSES)) if unused else class_scores(self.weights, features)
        tasks = np.tile(self.code(read_tasks()[task]), (count, 1))
        return Inputs(features, classes, np.tile(known, (count, 1)), tasks, np.ones(count))

    def logits(self, pictures: np.ndarray, task: str, facts: Sequence[float] = ()) -> np.ndarray:
        """Logits (N, types) of whether each type occurs, see :meth:`answers`."""
        _, occurs = self.answers(pictures, task, facts)
        return np.asarray(logit(np.clip(occurs, LEAST, 1 - LEAST)))

    def features(self, pictures: np.ndarray) -> np.ndarray:
        """Features (N, F) of images (N, H, W, 3) uint8."""
        return forward(self.backbone, torch.from_numpy(np.ascontiguousarray(pictures))).numpy()


def write_general(
    head: GeneralHead,
    code: TaskCode,
    strangeness: Strangeness,
    card: GeneralCard,
    files: tuple[str | Path, str | Path],
) -> None:
    """Write the numbers of a head, in single precision or less, and its card."""
    arrays = {
        "features_middle": head.features.middle,
        "features_directions": head.features.directions,
        "classes_middle": head.classes.middle,
        "classes_directions": head.classes.directions,
        "facts": head.facts,
        "weights": head.weights,
        "task_middle": code.middle,
        "task_directions": code.directions,
        "strange_middle": strangeness.spread.middle,
        "strange_directions": strangeness.spread.directions,
        "strange_limit": np.array(strangeness.limit),
    }
    named: dict[str, np.ndarray] = {}
    if head.memory:
        arrays |= {f"memory_{name}": getattr(head.memory, name) for name in REMEMBERED}
        named = {"memory_objects": head.memory.objects.astype(np.str_)}
    numbers = {
        name: array.astype(np.float16 if name in HALVED else np.float32)
        for name, array in arrays.items()
    }
    write_npz(files[0], {**numbers, **named})
    card.write(files[1])


def _memory(arrays: Mapping[str, np.ndarray], settings: MemorySettings) -> Memory | None:
    """The memory of a head, from its file."""
    if not settings.last_features:
        return None
    numbers = {name: arrays[f"memory_{name}"] for name in REMEMBERED}
    return Memory(settings, arrays["memory_objects"], **numbers)


def load_general(
    folder: str | Path = TRAINED, timeout_s: float = 0, weights: Weights | None = None
) -> GeneralNetwork:
    """Load a head, with the weights of its backbone on this machine.

    Args:
        folder: with both files.
        timeout_s: how long to wait for weights that are not here; 0 disables network access.
        weights: of the backbone; default: those of this machine.

    Raises:
        InputError: a file is missing or damaged, or the weights are not those learned with.
    """
    path, card = Path(folder, HEAD), GeneralCard.read(Path(folder, CARD))
    weights = weights or weights_of(card.backbone, timeout_s)
    if not card.weights.endswith(f"({weights.sha256[:8]})"):
        message = f"learned with {card.weights}; here is {weights.name}"
        raise InputError(Path(folder, CARD), "weights", message)
    arrays = read_npz(path)
    arrays |= {name: arrays[name].astype(np.float32) for name in HALVED if name in arrays}
    try:
        head = GeneralHead(
            card.head,
            Projection(arrays["features_middle"], arrays["features_directions"]),
            Projection(arrays["classes_middle"], arrays["classes_directions"]),
            arrays["facts"],
            arrays["weights"],
            _memory(arrays, card.head.memory),
        )
        code = TaskCode(arrays["task_middle"], arrays["task_directions"])
        spread = Projection(arrays["strange_middle"], arrays["strange_directions"])
        strangeness = Strangeness(spread, float(arrays["strange_limit"]))
    except KeyError as error:
        raise InputError(path, str(error.args[0]), "this array is missing") from error
    backbone = load_backbone(weights, card.input_px)
    return GeneralNetwork(backbone, weights, head, code, card, strangeness)
