"""How well tasks in words are understood: reports/task_words.csv.

Run from the repository:

    python benchmarks/task_words.py

It draws 50 phrases (verb x object x form) of each half of benchmarks/task_phrases.yaml: 40 that
name one of the ten tasks, 10 that name none. `tune` was looked at while the lexicon was written,
`test` was not. A phrase that names no task is correct if it is refused.
"""

from __future__ import annotations

import sys
from itertools import product
from pathlib import Path

import pandas as pd
import pandera.pandas as pa

from grasptypes.errors import InputError
from grasptypes.seeds import rng
from grasptypes.settings.task_words import find_task
from grasptypes.settings.tasks import read_tasks
from grasptypes.tables import write_table
from grasptypes.yaml_files import read_yaml

PHRASES = Path(__file__).with_name("task_phrases.yaml")
OF_TASK, OF_NONE = 4, 10  # phrases of each half
PHRASE_SCHEMA = pa.DataFrameSchema(
    {
        "half": pa.Column(str, pa.Check.isin(["tune", "test"])),
        "phrase": pa.Column(str),
        "task": pa.Column(str),
        "answer": pa.Column(str),
        "correct": pa.Column(bool),
    },
    strict=True,
    unique=["phrase"],
)


def phrases(half: str) -> list[tuple[str, str]]:
    """Phrases of a half with their tasks, empty for none."""
    content = read_yaml(PHRASES)
    drawn = []
    for task, words in content[half].items():
        every = list(product(words["verbs"], words["objects"], content["forms"]))
        chosen = rng("task_phrases", half, task).permutation(len(every))
        for number in chosen[: OF_TASK if task else OF_NONE]:
            verb, thing, form = every[number]
            base, ing, done = (part.strip().replace("{}", thing) for part in verb.split(","))
            drawn.append((form.format(base=base, ing=ing, done=done), task))
    return drawn


def measure() -> pd.DataFrame:
    """A table of `PHRASE_SCHEMA`, one row per phrase."""
    rows = []
    for half in ("tune", "test"):
        for phrase, task in phrases(half):
            try:
                answer = find_task(phrase, list(read_tasks()))
            except InputError:
                answer = ""
            rows.append((half, phrase, task, answer, answer == task))
    return pd.DataFrame(rows, columns=list(PHRASE_SCHEMA.columns))


if __name__ == "__main__":
    table = measure()
    write_table(table, "reports/task_words.csv", PHRASE_SCHEMA)
    for (half, named), group in table.groupby(["half", table["task"] != ""], sort=False):
        kind = "that name a task" if named else "out of domain"
        sys.stdout.write(f"{half}: {group['correct'].sum()} of {len(group)} phrases {kind}\n")
