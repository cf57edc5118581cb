"""Model (f): the task is told by a second image, in which it is done with another object.

Demonstrations are split like the images: a head that is tested on a fold of the images is shown
demonstrations of that fold, and has learnt from those of the others.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.errors import InputError
from grasptypes.files import read_npz
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.members import members_by_group
from grasptypes.predictors.scoring import METRIC_SCHEMA, SHORT, score
from grasptypes.predictors.training import fit, predict
from grasptypes.seeds import rng
from grasptypes.settings.demonstrations import DemonstrationTable
from grasptypes.settings.predictors import NO_TASK, PredictorSettings

# Tasks that can be shown; in an archive, images show them in turn.
TASKS = ("handoff", "use")
# What no demonstration in training shares with those of the test: the image, also the object, or
# also the action with which it is used.
SPLITS = ("views", "objects", "actions")
# The task that a test's demonstration shows: that of the label, the other one, or no demonstration.
TOLD = ("right", "wrong", "none")
MODEL = "demonstration"
# The same model with grasps alone, without the second hand or what the object acts on.
ALONE = "grasp_alone"

# Empty for models that are told the task otherwise.
_KEYS = {"split": pa.Column(str, nullable=True), "told": pa.Column(str, nullable=True)}
TRIAL_SCHEMA = pa.DataFrameSchema(
    {**METRIC_SCHEMA.columns, "model": pa.Column(str, pa.Check.isin([MODEL, ALONE])), **_KEYS},
    strict=True,
    coerce=True,
    unique=["labels", "split", "told", "group", "seed"],
)
_SHARE = pa.Check.in_range(0, 1)
DEMONSTRATION_SCHEMA = pa.DataFrameSchema(
    {
        "labels": pa.Column(str),
        "model": pa.Column(str),
        **_KEYS,
        **{
            f"{short}_{part}": pa.Column(float, _SHARE)
            for short in SHORT.values()
            for part in ("mean", "sd")
        },
        "n_runs": pa.Column(int, pa.Check.ge(2), description="folds and seeds"),
    },
    strict=True,
    unique=["labels", "model", "split", "told"],
)


@dataclass(frozen=True)
class Demonstrations:
    """Features of all demonstrations.

    Attributes:
        index: columns object, task and view, one row per image.
        features: (D, F) float32.
    """

    index: pd.DataFrame
    features: np.ndarray


def read_features(paths: Iterable[str | Path], tasks: Sequence[str] = TASKS) -> Demonstrations:
    """Demonstrations from files of features, named after their objects.

    Args:
        tasks: that images show in turn.

    Raises:
        InputError: a file has not the same number of images of each task.
    """
    tables, parts = [], []
    for path in map(Path, paths):
        found = read_npz(path)[NO_TASK]
        views, rest = divmod(len(found), len(tasks))
        if rest:
            raise InputError(path, NO_TASK, f"{len(found)} images of {len(tasks)} tasks")
        shown = {"task": np.tile(tasks, views), "view": np.repeat(np.arange(views), len(tasks))}
        tables.append(pd.DataFrame({"object": path.stem, **shown}))
        parts.append(found)
    return Demonstrations(pd.concat(tables, ignore_index=True), np.concatenate(parts))


def together(several: Sequence[Demonstrations]) -> Demonstrations:
    """One table of several."""
    index = pd.concat([each.index for each in several], ignore_index=True)
    return Demonstrations(index, np.concatenate([each.features for each in several]))


def folds_of(
    index: pd.DataFrame, split: str, table: DemonstrationTable, folds: int, seed: int
) -> np.ndarray:
    """Fold (D,) of each demonstration; each fold has about as many views, objects or actions.

    Args:
        index: of the demonstrations.
        split: one of :data:`SPLITS`.
        seed: of the workflow.
    """
    if split == "views":
        return np.asarray(index["view"] % folds)
    action = {name: use.action for name, use in table.uses.items()}
    groups = index["object"] if split == "objects" else index["object"].map(action)
    names = rng("demonstrations", split, seed).permutation(sorted(set(groups)))
    place = {str(name): number % folds for number, name in enumerate(names)}
    return np.asarray(groups.map(place))


def shown_beside(
    examples: pd.DataFrame, index: pd.DataFrame, wrong: bool, random: np.random.Generator
) -> np.ndarray:
    """The row of a demonstration for each example: of its fold and task, with another object.

    Args:
        examples: index of :class:`Examples`.
        index: of the demonstrations, with their folds.
        wrong: show another task.

    Raises:
        InputError: no other object demonstrates the task in a fold.
    """
    rows = np.zeros(len(examples), dtype=int)
    for (name, task, fold), group in examples.groupby(["object", "task", "fold"]):
        fits = (index["object"] != name) & (index["fold"] == fold)
        candidates = np.flatnonzero(fits & ((index["task"] == task) != wrong))
        if not len(candidates):
            message = f"no other object than {name} is demonstrated in fold {fold}"
            raise InputError("params.yaml", "objects.names", message)
        rows[group.index] = random.choice(candidates, len(group))
    return rows


def try_demonstrations(
    examples: Examples,
    demonstrations: Demonstrations,
    table: DemonstrationTable,
    settings: tuple[PredictorSettings, float],
    seed: int,
) -> pd.DataFrame:
    """Train and test on the folds of the images, for every split of the demonstrations.

    Args:
        examples: those of the model that is not told the task.
        settings: of training, and the share of training examples without a demonstration.
        seed: of the workflow.

    Returns:
        one row per split, kind of demonstration, fold and seed.
    """
    training, missing = settings
    folds = examples.index["fold"].nunique()
    members = members_by_group(examples.index["fold"], training.seeds)
    tables = []
    for split in SPLITS:
        key = (MODEL, split, seed)
        fold = folds_of(demonstrations.index, split, table, folds, seed)
        index = demonstrations.index.assign(fold=fold)
        seen = {
            told: demonstrations.features[
                shown_beside(examples.index, index, told == "wrong", rng(*key, told))
            ]
            for told in ("right", "wrong")
        }
        seen["none"] = np.zeros_like(seen["right"])
        hidden = rng(*key, "missing").random(len(examples.index)) < missing
        heads, _ = fit(
            beside(examples, np.where(hidden[:, None], 0, seen["right"])), members, training, key
        )
        for told in TOLD:
            tested = beside(examples, seen[told])
            logits = [predict(heads, k, tested, member.test) for k, member in enumerate(members)]
            metrics, _ = score(tested, members, logits)
            tables.append(metrics.assign(split=split, told=told))
    return pd.concat(tables, ignore_index=True)


def beside(examples: Examples, second: np.ndarray) -> Examples:
    """The examples with the features of a second image beside those of the first."""
    inputs = np.hstack([examples.inputs, second]).astype(np.float32)
    return replace(examples, inputs=inputs)


def summarize(trials: pd.DataFrame, others: pd.DataFrame) -> pd.DataFrame:
    """A table of :data:`DEMONSTRATION_SCHEMA`.

    Args:
        trials: of :data:`TRIAL_SCHEMA`.
        others: of :data:`METRIC_SCHEMA`: models to compare with, on the same folds.
    """
    rows = []
    keys = ["labels", "model", "split", "told"]
    everything = pd.concat([others.assign(split="", told=""), trials])
    for names, group in everything.groupby(keys, sort=False):
        values = {
            f"{short}_{part}": getattr(group[long], function)()
            for long, short in SHORT.items()
            for part, function in (("mean", "mean"), ("sd", "std"))
        }
        rows.append(dict(zip(keys, names, strict=True)) | values | {"n_runs": len(group)})
    return pd.DataFrame(rows).sort_values("labels", kind="stable", ignore_index=True).round(6)


def markdown(table: pd.DataFrame) -> str:
    """The table, mean ± spread in one cell."""
    heads = ["labels", "model", "new in the test's demonstrations", "demonstration"]
    lines = [[*heads, *_MEASURES], ["---"] * (len(heads) + len(_MEASURES))]
    for row in table.to_dict("records"):
        cells = [str(row[key]) for key in ("labels", "model", "split", "told")]
        shorts = _MEASURES.values()
        cells += [f"{row[f'{s}_mean']:.3f} ± {row[f'{s}_sd']:.3f}" for s in shorts]
        lines.append(cells)
    rows = "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
    return f"{rows}\n\n± in the table: standard deviation over folds and seeds.\n"


_MEASURES: Mapping[str, str] = {"similarity": "sim", "accuracy": "acc", "precision": "prec"}
