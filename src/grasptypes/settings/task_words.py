"""Tasks in words: which known task a text such as "pour water into a glass" means.

A lexicon (task_words.yaml) says how people name tasks. It needs no model and no network.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from difflib import SequenceMatcher
from functools import cache
from pathlib import Path
from typing import Annotated

from pydantic import Field

from grasptypes.errors import InputError
from grasptypes.settings.base import Name, Settings, Unique, setting
from grasptypes.yaml_files import read_yaml

TASK_WORDS = Path(__file__).with_suffix(".yaml")
GENERAL = "use"  # the task that stands for what an object is made for
GAP = 5  # other words between two words of an expression: "put the big red cup away"
NEAREST = 3
# What follows one of these is a noun: "the hammer" is no verb.
DETERMINERS = frozenset({"a", "an", "the", "this", "my", "your", "his", "its", "our", "their"})
Words = Annotated[str, Field(pattern=r"^[a-z]+( [a-z]+)*$")]


class TaskWords(Settings):
    """How people name one task."""

    expressions: Unique[Words] = setting("verbs, with the words that follow them", min_length=1)
    nouns: Unique[Words] = setting("what the task is done to or with")
    use: bool = setting("whether a model without this task takes it for `use`")
    reason: str = setting("why these words", min_length=1)


class Lexicon(Settings):
    """How people name all tasks."""

    tasks: dict[Name, TaskWords] = setting("words by task", min_length=1)
    forms: dict[Words, Unique[Words]] = setting("irregular forms by base form")


@cache
def read_lexicon(path: str | Path = TASK_WORDS) -> Lexicon:
    """The words of all tasks.

    Raises:
        InputError: names the file and the key of the first mistake.
    """
    return Lexicon.check(read_yaml(path), path)


def find_task(text: str, known: Collection[str]) -> str:
    """The known task that a text names; exact names name themselves.

    A task that is not known, but is a use of objects made for it, counts as `use`.

    Args:
        text: a name of a task, or words such as "pour water into a glass".
        known: names of the tasks to choose from.

    Raises:
        InputError: the text names no known task, or several equally; lists the nearest ones.
    """
    if text in known:
        return text
    words = re.findall(r"[a-z]+", text.lower())
    scores: dict[str, tuple[int, bool, int]] = {}
    for name, task in read_lexicon().tasks.items():
        length = max(_length(expression.split(), words) for expression in task.expressions)
        chosen = name if name in known or not task.use else GENERAL
        if length and chosen in known:
            score = (length, name != GENERAL, _nouns(task, words))
            scores[chosen] = max(score, scores.get(chosen, score))
    best = [name for name, score in scores.items() if score == max(scores.values())]
    if len(best) == 1:
        return best[0]
    said = f"names {len(best)} tasks equally" if best else "names no known task"
    nearest = best or _nearest(words, known)
    raise InputError("--task", " ".join(text.split()), f"{said}; nearest: {', '.join(nearest)}")


def _length(expression: Sequence[str], words: Sequence[str]) -> int:
    """Number of words of an expression if the text contains it, else 0."""
    pairs = zip(["", *words], words, strict=False)
    starts = [
        place
        for place, (before, word) in enumerate(pairs, 1)
        if word in _forms(expression[0]) and before not in DETERMINERS
    ]
    return len(expression) if any(_follows(expression[1:], words[n:]) for n in starts) else 0


def _follows(expression: Sequence[str], words: Sequence[str]) -> bool:
    """Whether the words contain those of the expression in order, none far from the last."""
    for wanted in expression:
        places = [place for place, word in enumerate(words) if word in _forms(wanted)]
        if not places or places[0] > GAP:
            return False
        words = words[places[0] + 1 :]
    return True


def _nouns(task: TaskWords, words: Sequence[str]) -> int:
    return sum(any(word in _forms(noun) for word in words) for noun in task.nouns)


@cache
def _forms(word: str) -> frozenset[str]:
    """A word in its base form, its regular English forms, and its irregular ones."""
    stem = word[:-1] if word.endswith("e") else word
    forms = {word, f"{word}s", f"{word}es", f"{stem}ed", f"{stem}ing"}
    if word.endswith("y"):
        forms |= {f"{word[:-1]}ies", f"{word[:-1]}ied"}
    if re.search(r"[aeiou][bdgklmnpt]$", word):  # chop: chopping, chopped
        forms |= {f"{word}{word[-1]}ed", f"{word}{word[-1]}ing"}
    return frozenset(forms).union(read_lexicon().forms.get(word, ()))


def _nearest(words: Sequence[str], known: Collection[str]) -> list[str]:
    """The known tasks with the most nouns in the text, then with the most similar spelling."""
    lexicon = read_lexicon().tasks

    def nearness(name: str) -> tuple[int, float]:
        """Nouns of a task in the text, then the closest spelling of its name or expressions."""
        task = lexicon.get(name)
        verbs = [name, *(task.expressions if task else [])]
        pairs = [SequenceMatcher(None, verb, word).ratio() for verb in verbs for word in words]
        return (_nouns(task, words) if task else 0), max(pairs, default=0.0)

    return sorted(known, key=nearness, reverse=True)[:NEAREST]
