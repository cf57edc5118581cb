"""What a predictor answers, and how answers are written as text and JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from grasptypes.files import write_json
from grasptypes.predictors.general_predictor import GeneralCard
from grasptypes.predictors.known_kinds import Neighbour
from grasptypes.predictors.metrics import SIGMOID_THRESHOLD
from grasptypes.predictors.predictor_files import ModelCard
from grasptypes.records import Record
from grasptypes.settings.base import Many

Card = ModelCard | GeneralCard
# Of the JSON that `grasptypes predict --json` prints, and where its schema is: written by
# `python -m grasptypes.predictors.answers`.
VERSION: Literal["grasptypes.answers/1"] = "grasptypes.answers/1"
PLACE = "docs/answer.schema.json"


@dataclass(frozen=True)
class Answer:
    """Prediction for one image, or for several of one object together.

    Attributes:
        name: of the image or object.
        probabilities: how likely each type occurs at all, by its name as in `GRASP_TYPES`, best
            first.
        shares: the share of the grasps that have each type, in the same order; sums to one.
        neighbours: the known kinds that look most like it, best first; only of `general`.
        strangeness: how unlike all known kinds it looks; above 1 nothing known is like it. None if
            the model does not say.
        size_m: lengths that were used, longest first: what the user said or depth showed.
        warnings: what is doubtful, a sentence each.
    """

    name: str
    probabilities: Mapping[str, float]
    shares: Mapping[str, float]
    neighbours: tuple[Neighbour, ...] = ()
    strangeness: float | None = None
    size_m: tuple[float, ...] = ()
    warnings: tuple[str, ...] = ()

    @property
    def chosen(self) -> tuple[str, ...]:
        """The types that rather occur than not, best first (paper, section IV-B).

        If there are none, that with the largest share.
        """
        found = tuple(t for t, value in self.probabilities.items() if value > SIGMOID_THRESHOLD)
        return found or (max(self.shares, key=lambda name: self.shares[name]),)

    @property
    def confidence(self) -> float:
        """The expected share of types about which `probabilities` is on the right side of a half.

        From 0.5, no idea, to 1.
        """
        chances = np.array(list(self.probabilities.values()))
        return float(np.maximum(chances, 1 - chances).mean())

    @classmethod
    def of(cls, name: str, types: Sequence[str], shares: np.ndarray, occurs: np.ndarray) -> Answer:
        """The answer of a network.

        Args:
            types: (K) as spelled in cards.
            shares: (K,) share of each type.
            occurs: (K,) probability of each type.
        """
        order = np.lexsort((-shares, -occurs))
        names = [spelled(types[k]) for k in order]
        chances, parts = ([float(row[k]) for k in order] for row in (occurs, shares))
        return cls(
            name, dict(zip(names, chances, strict=True)), dict(zip(names, parts, strict=True))
        )


class TypeRecord(Record):
    """One grasp type of an answer."""

    type: str
    probability: float
    share: float
    chosen: bool


class NeighbourRecord(Record):
    """A known kind that looks like what is shown."""

    kind: str
    similarity: float


class AnswerRecord(Record):
    """An answer; the types are sorted by probability."""

    name: str
    types: Many[TypeRecord]
    confidence: float
    neighbours: Many[NeighbourRecord]
    strangeness: float | None
    size_m: Many[float]
    warnings: Many[str]


class AnswersRecord(Record):
    """What `grasptypes predict --json` prints; `version` changes when a key changes its meaning."""

    version: Literal["grasptypes.answers/1"]
    model: str
    labels: str
    calibrated: bool
    task: str | None
    task_learned: bool
    backbone: str
    weights: str
    finetune: str
    answers: Many[AnswerRecord]


def described(answers: Sequence[Answer], card: Card, task: str) -> AnswersRecord:
    """Answers as they are written as JSON."""
    return AnswersRecord(
        version=VERSION,
        model=card.model,
        labels=card.labels,
        calibrated=isinstance(card, GeneralCard),
        task=task if card.sees_task else None,
        task_learned=task in card.learned,
        backbone=card.backbone,
        weights=card.weights,
        finetune=card.finetune,
        answers=tuple(map(_described, answers)),
    )


def _described(answer: Answer) -> AnswerRecord:
    types = tuple(
        TypeRecord(
            type=name, probability=value, share=answer.shares[name], chosen=name in answer.chosen
        )
        for name, value in answer.probabilities.items()
    )
    near = tuple(
        NeighbourRecord(kind=one.name, similarity=one.similarity) for one in answer.neighbours
    )
    return AnswerRecord(
        name=answer.name,
        types=types,
        confidence=answer.confidence,
        neighbours=near,
        strangeness=answer.strangeness,
        size_m=answer.size_m,
        warnings=answer.warnings,
    )


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
    lines = [answer.name, f"{'':18}probability  share"]
    for name, value in answer.probabilities.items():
        mark = "  chosen" if name in answer.chosen else ""
        lines.append(f"{name:18}{value:11.3f}  {answer.shares[name]:5.3f}{mark}")
    lines.append(f"{'confidence':18}{answer.confidence:11.3f}")
    if answer.size_m:
        lines.append(f"{'size':18}{' x '.join(f'{value:.3g}' for value in answer.size_m):>11} m")
    if answer.neighbours:
        alike = (
            f"{one.name.replace('_', ' ')} ({one.similarity:.2f})" for one in answer.neighbours
        )
        lines.append(f"{'looks like':18}  {', '.join(alike)}")
    return lines + [f"warning: {text}" for text in answer.warnings]


def _rows(answers: Sequence[Answer]) -> list[str]:
    width = max(len(answer.name) for answer in answers)
    kinds = sorted(answers[0].probabilities)
    lines = ["  ".join([" " * width, *kinds, "chosen"])]
    for answer in answers:
        cells = [f"{answer.probabilities[kind]:{len(kind)}.3f}" for kind in kinds]
        lines.append("  ".join([f"{answer.name:{width}}", *cells, ", ".join(answer.chosen)]))
    return lines + [f"warning: {one.name}: {text}" for one in answers for text in one.warnings]


def spelled(kind: str) -> str:
    """A type as spelled in the published table."""
    return kind.replace("_", " ").title()


def write_schema(path: str | Path = PLACE) -> None:
    """Write the JSON schema of the answers."""
    write_json(path, AnswersRecord.model_json_schema())


if __name__ == "__main__":
    write_schema()
