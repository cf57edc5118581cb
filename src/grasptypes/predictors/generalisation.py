"""Effect of more shapes per object on objects that are left out in all their shapes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.objects.variants import base_of, variant_names
from grasptypes.predictors.ceilings import constant_of_others
from grasptypes.predictors.examples import Examples, assemble
from grasptypes.predictors.members import members_by_object
from grasptypes.predictors.protocol import try_splits
from grasptypes.predictors.scoring import METRIC_SCHEMA, SHORT
from grasptypes.predictors.variants import VARIANTS
from grasptypes.settings.predictors import PredictorSettings, VariantTrial

Inputs = dict[str, dict[str, np.ndarray]]


TRIAL_SCHEMA = pa.DataFrameSchema(
    {
        **METRIC_SCHEMA.columns,
        "shapes": pa.Column(int, pa.Check.ge(1)),
        "views": pa.Column(int, pa.Check.ge(1)),
    },
    strict=True,
    coerce=True,
    unique=["labels", "model", "shapes", "views", "group", "seed"],
)
_SHARE = pa.Check.in_range(0, 1)
GENERALISATION_SCHEMA = pa.DataFrameSchema(
    {
        "labels": pa.Column(str),
        "model": pa.Column(str, pa.Check.isin(list(VARIANTS))),
        "shapes": pa.Column(int, pa.Check.ge(1)),
        "views": pa.Column(int, pa.Check.ge(1)),
        "n_train": pa.Column(float, description="examples, mean over the objects left out"),
        "n_objects": pa.Column(int, pa.Check.ge(2)),
        "n_seeds": pa.Column(int, pa.Check.ge(1)),
        **{f"{short}_mean": pa.Column(float, _SHARE) for short in SHORT.values()},
        "sim_sd": pa.Column(float, description="over the objects left out"),
        "sim_gain": pa.Column(float, nullable=True, description="over one shape, pictures equal"),
        "sim_gain_se": pa.Column(float, nullable=True, description="over the objects left out"),
        "constant_sim": pa.Column(float, _SHARE, description="of the constant of the others"),
        "backbone": pa.Column(str),
        "weights": pa.Column(str),
    },
    strict=True,
    ordered=True,
    unique=["labels", "model", "shapes", "views"],
)


@dataclass(frozen=True)
class VariantInputs:
    """The data of all trials.

    Attributes:
        objects: object to encoding to (V, F) features.
        variants: the same for variants, which have the labels of their objects.
        samples: of :mod:`grasptypes.labels.samples`, for the objects.
        tasks: in the order of the task vector.
    """

    objects: Inputs
    variants: Inputs
    samples: pd.DataFrame
    tasks: Sequence[str]


def try_trial(
    known: VariantInputs,
    model: str,
    trial: VariantTrial,
    settings: PredictorSettings,
    draws: tuple[int, int],
) -> pd.DataFrame:
    """Leave out every object in turn and test on all its own images.

    Args:
        model: name of the model.
        draws: number of repetitions, and the workflow's seed.

    Returns:
        one row per object and repetition, as in :func:`grasptypes.predictors.scoring.score`.
    """
    seeds, seed = draws
    examples = trial_examples(known, model, trial)
    index = examples.index
    members = members_by_object(index["object"], seeds, index["view"].to_numpy() < trial.views)
    key = ("shapes", model, trial.shapes, trial.views, seed)
    return try_splits(examples, members, settings, key).metrics


def trial_examples(known: VariantInputs, model: str, trial: VariantTrial) -> Examples:
    """Images of the objects, and the first images of their first variants."""
    inputs = dict(known.objects)
    for name in known.objects:
        for variant in variant_names(name, trial.shapes - 1):
            shown = known.variants[variant]
            inputs[variant] = {encoding: views[: trial.views] for encoding, views in shown.items()}
    # There are no folds here: objects are left out.
    views = {name: len(next(iter(shown.values()))) for name, shown in inputs.items()}
    folds = pd.concat(
        pd.DataFrame({"object": name, "view": np.arange(count), "fold": 0})
        for name, count in views.items()
    )
    labelled = inherit(known.samples, list(inputs))
    return assemble(VARIANTS[model], inputs, labelled, folds, list(known.tasks))


def inherit(samples: pd.DataFrame, names: Sequence[str]) -> pd.DataFrame:
    """Samples of objects and variants; a variant has those of its object."""
    of_base = dict(list(samples.groupby("object")))
    return pd.concat([of_base[base_of(name)].assign(object=name) for name in names])


def summarize(trials: pd.DataFrame, constant: Mapping[tuple[str, str], float]) -> pd.DataFrame:
    """One row per label source, model and trial: a table of :data:`GENERALISATION_SCHEMA`.

    Args:
        trials: of :data:`TRIAL_SCHEMA`.
        constant: label source and model to the similarity of :func:`constant_similarity`.
    """
    keys = ["labels", "model", "shapes", "views"]
    rows = []
    for name, group in trials.groupby(keys, sort=True):
        labels, model, shapes, views = name
        by_object = group.groupby("group")[list(SHORT)].mean()
        gain = _gain(trials, group, int(shapes) * int(views)) if shapes > 1 else None
        rows.append(
            dict(zip(keys, name, strict=True))
            | {"n_train": group["n_train"].mean(), "n_objects": len(by_object)}
            | {"n_seeds": group["seed"].nunique()}
            | {f"{short}_mean": by_object[long].mean() for long, short in SHORT.items()}
            | {"sim_sd": by_object["angular_similarity"].std()}
            | {"sim_gain": np.nan if gain is None else gain.mean()}
            | {"sim_gain_se": np.nan if gain is None else gain.sem()}
            | {"constant_sim": constant[str(labels), str(model)]}
            | {key: group[key].iloc[0] for key in ("backbone", "weights")}
        )
    table = pd.DataFrame(rows)
    order = {model: place for place, model in enumerate(VARIANTS)}
    table = table.sort_values(keys, key=lambda c: c.map(order) if c.name == "model" else c)
    return table[list(GENERALISATION_SCHEMA.columns)].round(6).reset_index(drop=True)


def constant_similarity(samples: pd.DataFrame) -> dict[str, float]:
    """Model to the similarity of the constant answer fitted to the other objects.

    Args:
        samples: of :mod:`grasptypes.labels.samples`.

    Returns:
        means over the objects left out, see :func:`ceilings.constant_of_others`.
    """
    measure = "angular_similarity"
    mean = {joint: constant_of_others(samples, joint)[measure].mean() for joint in (False, True)}
    return {model: float(mean[variant.joint_labels]) for model, variant in VARIANTS.items()}


def _gain(trials: pd.DataFrame, group: pd.DataFrame, pictures: int) -> pd.Series | None:
    """Gain in similarity over one shape with as many images, for each object left out."""
    first = group.iloc[0]
    alone = trials[
        (trials["labels"] == first["labels"])
        & (trials["model"] == first["model"])
        & (trials["shapes"] == 1)
        & (trials["views"] == pictures)
    ]
    if alone.empty:
        return None
    measure = "angular_similarity"
    return group.groupby("group")[measure].mean() - alone.groupby("group")[measure].mean()


def describe(table: pd.DataFrame) -> str:
    """One sentence on the effect of more shapes.

    Args:
        table: of :data:`GENERALISATION_SCHEMA`.
    """
    most = table[table["sim_gain"].notna()]
    most = most[most["shapes"] == most["shapes"].max()]
    gains = ", ".join(
        f"{row.labels} {row.model} {row.sim_gain:+.3f} ± {row.sim_gain_se:.3f}"
        for row in most.itertuples()
    )
    above = int((most["sim_mean"] > most["constant_sim"]).sum())
    return (
        f"{most['shapes'].max()} shapes an object in place of one, with as many pictures, change "
        f"the similarity on objects left out by {gains}; {above} of {len(most)} models then "
        "exceed the constant answer that is fitted to the other objects."
    )
