"""Tables of the models that are told one of many tasks, and of answers to compare them with."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.labels.samples import COUNTS
from grasptypes.predictors.metrics import METRICS, angular_similarity
from grasptypes.predictors.scoring import SHORT
from grasptypes.predictors.told import MODELS
from grasptypes.settings.tasks import TASKS, read_tasks

# Answers from the labels alone: the best one to all pairs, and the best one to each object. With
# unseen tasks they are the best for the other tasks, otherwise for those that they are tested on.
REFERENCES = {"constant": "best constant answer", "object_known": "best answer to each object"}
SPLITS = ("views", "tasks")
# What is averaged over: all pairs, those of the tasks that every number of tasks includes, or those
# of objects whose labels are not the same for all of their tasks.
EVERYTHING, COMMON, DIFFERING = "all", "common", "differing"

_SHARE = pa.Check.in_range(0, 1)
TRIAL_SCHEMA = pa.DataFrameSchema(
    {
        "model": pa.Column(str, pa.Check.isin(list(MODELS))),
        "split": pa.Column(str, pa.Check.isin(SPLITS)),
        "tasks": pa.Column(int, pa.Check.ge(2)),
        "group": pa.Column(str, description="fold, or the task that was not learnt from"),
        "seed": pa.Column(int, pa.Check.ge(0)),
        "object": pa.Column(str),
        "task": pa.Column(str, pa.Check.isin(list(read_tasks(TASKS)))),
        "n_test": pa.Column(int, pa.Check.ge(1)),
        **{name: pa.Column(float, _SHARE) for name in METRICS},
    },
    strict=True,
    coerce=True,
    unique=["model", "split", "tasks", "group", "seed", "object", "task"],
)
_MEANS = [f"{short}_mean" for short in SHORT.values()]
TABLE_SCHEMA = pa.DataFrameSchema(
    {
        "split": pa.Column(str, pa.Check.isin(SPLITS)),
        "model": pa.Column(str, pa.Check.isin([*MODELS, *REFERENCES])),
        "tasks": pa.Column(int, pa.Check.ge(2)),
        "evaluated": pa.Column(str, description="which pairs, or a task"),
        "sim_mean": pa.Column(float, _SHARE),
        "sim_se": pa.Column(float, pa.Check.ge(0), nullable=True),
        "gain": pa.Column(float, nullable=True, description="similarity less that of no_task"),
        "gain_se": pa.Column(float, pa.Check.ge(0), nullable=True),
        **{name: pa.Column(float, _SHARE, nullable=True) for name in _MEANS[1:]},
        "n_pairs": pa.Column(int, pa.Check.ge(1), description="objects and tasks"),
        "n_runs": pa.Column(int, pa.Check.ge(0), description="folds or tasks, and seeds"),
    },
    strict=True,
    unique=["split", "model", "tasks", "evaluated"],
)


def summarize(trials: pd.DataFrame, samples: pd.DataFrame, tasks: Sequence[str]) -> pd.DataFrame:
    """A table of :data:`TABLE_SCHEMA`.

    Standard errors are those over folds and seeds; where tasks are left out, over tasks, each with
    the mean of its seeds, and for a single task over seeds.

    Args:
        trials: of :data:`TRIAL_SCHEMA`, all models.
        samples: of :mod:`grasptypes.labels.samples`.
        tasks: in the order in which their number grows.
    """
    numbers = sorted(set(trials["tasks"]))
    common = list(tasks[: numbers[0]])
    rows = []
    for number in numbers:
        chosen = trials[(trials["tasks"] == number) & (trials["split"] == "views")]
        known = samples[samples["task"].isin(tasks[:number])]
        kept: dict[str, tuple[str, list[str]]] = {
            EVERYTHING: ("task", list(tasks[:number])),
            COMMON: ("task", common),
            DIFFERING: ("object", differing(known)),
        }
        for evaluated, (column, values) in kept.items():
            pairs, part = (each[each[column].isin(values)] for each in (known, chosen))
            head = {"split": "views", "tasks": number, "evaluated": evaluated}
            rows += [head | row | {"n_pairs": len(pairs)} for row in _runs(part, mean_of_pairs)]
            rows += [head | row for row in _references(known, pairs) if len(pairs)]
    unseen = trials[trials["split"] == "tasks"]
    for number in sorted(set(unseen["tasks"])):
        head = {"split": "tasks", "tasks": number}
        shown = unseen[unseen["tasks"] == number]
        known = samples[samples["task"].isin(tasks[:number])]
        found: dict[str, list[float]] = {name: [] for name in REFERENCES}
        for task in tasks[:number]:
            own, others = known[known["task"] == task], known[known["task"] != task]
            of_task = head | {"evaluated": task}
            part = shown[shown["task"] == task]
            rows += [of_task | row | {"n_pairs": len(own)} for row in _runs(part, mean_of_pairs)]
            for row in _references(others, own):
                found[row["model"]].append(row["sim_mean"])
                rows.append(of_task | row)
        head |= {"evaluated": EVERYTHING, "n_pairs": len(known)}
        rows += [head | row for row in _runs(shown, _of_tasks)]
        for name, known_values in found.items():
            error = float(pd.Series(known_values).sem())
            mean = {"sim_mean": float(np.mean(known_values)), "sim_se": error}
            rows.append(head | {"model": name, **mean, "n_runs": 0})
    table = pd.DataFrame(rows, columns=list(TABLE_SCHEMA.columns))
    return table.round(6)


def mean_of_pairs(trials: pd.DataFrame) -> pd.DataFrame:
    """The measures of each run: the mean over its pairs."""
    total = trials.groupby(["group", "seed"])["n_test"].transform("sum")
    weighted = trials[list(METRICS)].mul(trials["n_test"] / total, axis=0)
    return weighted.groupby([trials["group"], trials["seed"]]).sum()


def _of_tasks(trials: pd.DataFrame) -> pd.DataFrame:
    """The measures of each task: the mean over its seeds."""
    return mean_of_pairs(trials).groupby(level="group").mean()


def _runs(
    trials: pd.DataFrame, measured: Callable[[pd.DataFrame], pd.DataFrame]
) -> list[dict[str, Any]]:
    """Rows of all models, with their change against the model that is not told the task."""
    of_model = {name: measured(part) for name, part in trials.groupby("model", sort=False)}
    rows: list[dict[str, Any]] = []
    for name, runs in of_model.items():
        similarity = runs["angular_similarity"]
        row = {"model": name, "sim_se": similarity.sem(), "n_runs": len(runs)}
        row |= {f"{short}_mean": runs[long].mean() for long, short in SHORT.items()}
        if name != "no_task" and "no_task" in of_model:
            change = similarity - of_model["no_task"]["angular_similarity"]
            row |= {"gain": change.mean(), "gain_se": change.sem()}
        rows.append(row)
    return rows


def _references(known: pd.DataFrame, tested: pd.DataFrame) -> list[dict[str, Any]]:
    """Rows of the answers from labels: the mean direction of all labels, or of an object's.

    An object without another task gets the answer to all pairs.
    """
    units = _units(known)
    everything = units.mean(axis=0)
    own = units.groupby(known["object"].to_numpy()).mean()
    answers = {
        "constant": [everything] * len(tested),
        "object_known": [own.loc[n] if n in own.index else everything for n in tested["object"]],
    }
    labels = (tested[list(COUNTS)] > 0).to_numpy(dtype=float)
    return [
        {
            "model": name,
            "sim_mean": float(angular_similarity(np.stack(answer), labels).mean()),
            "n_pairs": len(tested),
            "n_runs": 0,
        }
        for name, answer in answers.items()
    ]


def _units(samples: pd.DataFrame) -> pd.DataFrame:
    """Labels as unit vectors."""
    labels = (samples[list(COUNTS)] > 0).astype(float)
    return labels.div(np.sqrt((labels**2).sum(axis=1)), axis=0).reset_index(drop=True)


def differing(samples: pd.DataFrame) -> list[str]:
    """The objects whose labels are not the same for all of their tasks."""
    labels = samples[list(COUNTS)] > 0
    different = labels.groupby(samples["object"]).nunique().max(axis=1) > 1
    return list(different.index[different])


def label_similarity(samples: pd.DataFrame) -> float:
    """The mean similarity of an object's labels for two of its tasks; 1 if tasks do not matter."""
    values = []
    for _, group in samples.groupby("object"):
        labels = (group[list(COUNTS)] > 0).to_numpy(dtype=float)
        first, second = np.triu_indices(len(labels), 1)
        values += angular_similarity(labels[first], labels[second]).tolist()
    return float(np.mean(values))


def markdown(table: pd.DataFrame) -> str:
    """Two tables: similarity by number of tasks, and with tasks that were not learnt from."""
    names: Mapping[str, str] = {**MODELS, **REFERENCES}
    known = table[table["split"] == "views"]
    numbers = sorted(set(known["tasks"]))
    heads = [f"{number} tasks" for number in numbers]
    parts = {
        "all pairs of objects and tasks": EVERYTHING,
        f"the pairs of the first {numbers[0]} tasks": COMMON,
        "the pairs of objects whose labels differ between tasks": DIFFERING,
    }
    texts = []
    for meaning, evaluated in parts.items():
        grid = _grid(known, evaluated, [*names], numbers)
        lines = [[f"told by, tested on {meaning}", *heads]]
        lines += [[names[name], *cells] for name, cells in grid.items()]
        texts.append(_rows(lines))
    unseen = table[table["split"] == "tasks"].set_index(["model", "evaluated"])
    columns = list(dict.fromkeys(evaluated for _, evaluated in unseen.index))
    columns = [EVERYTHING, *(name for name in columns if name != EVERYTHING)]
    other = [["told by", *columns]]
    for name in [name for name in names if name in unseen.index.get_level_values(0)]:
        other.append([names[name], *(_cell(unseen.loc[(name, column)]) for column in columns)])
    notes = (
        "± in the tables: standard error over folds and seeds; of tasks left out, over tasks or, "
        "for one task, over seeds.\n"
    )
    shown = "\n\n".join(texts)
    return f"{shown}\n\nTasks left out of training:\n\n{_rows(other)}\n\n{notes}"


def _grid(
    table: pd.DataFrame, evaluated: str, models: Sequence[str], numbers: Sequence[int]
) -> dict[str, list[str]]:
    rows = table[table["evaluated"] == evaluated].set_index(["model", "tasks"])
    known = [name for name in models if name in rows.index.get_level_values(0)]
    return {name: [_cell(rows.loc[(name, number)]) for number in numbers] for name in known}


def _cell(row: pd.Series) -> str:
    error = row["sim_se"]
    return f"{row['sim_mean']:.3f}" + ("" if pd.isna(error) else f" ± {error:.3f}")


def _rows(cells: Sequence[Sequence[str]]) -> str:
    lines = [*cells[:1], ["---"] * len(cells[0]), *cells[1:]]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
