"""The tables of results: mean and spread over folds and seeds, with the paper and ceilings."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.predictors.ceilings import ceilings, constant_of_others, counts_asked
from grasptypes.predictors.scoring import SHORT
from grasptypes.predictors.variants import VARIANTS

# Table I of the paper: similarity, accuracy, precision.
PAPER = {
    "no_task": (0.81, 0.85, 0.87),
    "task_vector": (0.90, 0.88, 0.88),
    "task_in_image": (0.92, 0.92, 0.92),
    "ignores_task": (0.94, 0.98, 0.99),
}
# Its row (e): MobileNetV2 of Zandigohar et al., arXiv:2101.05357 (their InceptionV3 has 0.95).
LITERATURE = ("literature", 0.93)
# Their InceptionV3: a row without values, since its weights could not be obtained.
UNTRAINED = "e_inception_v3"
# The best constant answer for the joint labels of all tasks.
CONSTANT_JOINT = "best_constant_joint"
# The constant answer fitted to the other objects, by whether labels are joint.
CONSTANT_OF_OTHERS = {False: "constant_of_others", True: "constant_of_others_joint"}
PAPER_COLUMNS = ("paper_sim", "paper_acc", "paper_prec")
_SHARE = pa.Check.in_range(0, 1)
RESULT_SCHEMA = pa.DataFrameSchema(
    {
        "model": pa.Column(str),
        "labels": pa.Column(str),
        "backbone": pa.Column(str),
        "weights": pa.Column(str),
        **{
            f"{short}_{part}": pa.Column(float, _SHARE, nullable=True)
            for short in SHORT.values()
            for part in ("mean", "sd")
        },
        "n_folds": pa.Column(int, pa.Check.ge(0)),
        "n_seeds": pa.Column(int, pa.Check.ge(0)),
        **{name: pa.Column(float, nullable=True) for name in PAPER_COLUMNS},
        "ceiling_sim": pa.Column(float, _SHARE, nullable=True),
        "ceiling_acc": pa.Column(float, _SHARE, nullable=True),
        "ceiling_freq": pa.Column(float, _SHARE, nullable=True),
        "sim_over_constant": pa.Column(float, pa.Check.in_range(-1, 1), nullable=True),
        "sim_over_constant_se": pa.Column(float, pa.Check.ge(0), nullable=True),
    },
    strict=True,
)


def tabulate(
    metrics: pd.DataFrame, samples: pd.DataFrame, labels: str, unseen: bool = False
) -> pd.DataFrame:
    """The rows of Table I, or of Table II on unseen objects, for one label source.

    ``ceiling_*`` is what the model could reach with perfect recognition of the object: the
    task-blind ceiling for the model that does not know the task, 1 for the others.
    ``sim_over_constant`` is the similarity on an unseen object minus that of the constant answer
    fitted to the other objects, mean and standard error over the objects left out (paired). The
    reference predictors and the literature have their own rows; the models that ignore the task
    predict joint labels and therefore have their own constant answers.

    Args:
        metrics: rows of :data:`METRIC_SCHEMA` for this label source.
        samples: the label source's table of :mod:`grasptypes.labels.samples`.
        labels: name of the label source.
        unseen: whether the groups are objects left out of training. If so, the columns of the paper
            and the literature are empty; otherwise those of ``sim_over_constant`` are.

    Returns:
        a table of :data:`RESULT_SCHEMA`.
    """
    constants = {
        joint: constant_of_others(samples, joint) for joint in CONSTANT_OF_OTHERS if unseen
    }
    reference = _reference_scores(samples, constants)
    groups = {str(model): group for model, group in metrics.groupby("model")}
    rows = [
        {"model": model, "labels": labels}
        | _trained(groups[model], unseen)
        | ({} if unseen else paper_figures(model))
        | _ceiling(model, reference.loc["task_blind"])
        | _over(constants.get(variant.joint_labels), groups[model])
        for model, variant in VARIANTS.items()
        if model in groups
    ]
    rows.append({"model": UNTRAINED, "labels": labels})
    for name in reference.index:
        values = {f"{short}_mean": reference.loc[name, long] for long, short in SHORT.items()}
        rows.append({"model": name, "labels": labels} | values)
    if not unseen:
        rows.append({"model": LITERATURE[0], "labels": "", "paper_sim": LITERATURE[1]})
    return _typed(pd.DataFrame(rows, columns=list(RESULT_SCHEMA.columns)))


def paper_figures(model: str) -> dict[str, float]:
    """The paper's figures for a model by :data:`PAPER_COLUMNS`; NaN if it has none."""
    return dict(zip(PAPER_COLUMNS, PAPER.get(model, (np.nan,) * 3), strict=True))


def constant_rows(table: pd.DataFrame, labels: str) -> pd.DataFrame:
    """For each trained model, the row of the corresponding constant answer of the others.

    Args:
        table: of :data:`RESULT_SCHEMA`, on unseen objects.

    Returns:
        index model, with the columns of the table.
    """
    rows = table[table["labels"] == labels].set_index("model")
    models = rows.index[rows["n_folds"] > 0]
    named = [CONSTANT_OF_OTHERS[VARIANTS[model].joint_labels] for model in models]
    return rows.loc[named].set_axis(models)


def _reference_scores(
    samples: pd.DataFrame, constants: Mapping[bool, pd.DataFrame]
) -> pd.DataFrame:
    """The ceilings and constant answers: index reference predictor, columns measures.

    Args:
        constants: those of the other objects, by whether labels are joint.
    """
    reference = ceilings(counts_asked(samples, joint=False))
    joint_reference = ceilings(counts_asked(samples, joint=True))
    reference.loc[CONSTANT_JOINT] = joint_reference.loc["best_constant"]
    for joint, scores in constants.items():
        reference.loc[CONSTANT_OF_OTHERS[joint]] = scores.mean()
    return reference


def _trained(group: pd.DataFrame, unseen: bool) -> dict[str, object]:
    """Columns of a trained model; the spread is over folds and seeds, or over unseen objects.

    Args:
        group: the model's rows of :data:`METRIC_SCHEMA`.
        unseen: whether to average repetitions before computing the spread.
    """
    spread = group.groupby("group")[list(SHORT)].mean() if unseen else group
    return (
        {key: _only(group[key]) for key in ("backbone", "weights")}
        | {f"{short}_mean": group[name].mean() for name, short in SHORT.items()}
        | {f"{short}_sd": spread[name].std() for name, short in SHORT.items()}
        | {"n_folds": group["group"].nunique(), "n_seeds": group["seed"].nunique()}
    )


def _ceiling(model: str, task_blind: pd.Series) -> dict[str, float]:
    knows = model != "no_task"
    return {
        "ceiling_sim": 1.0 if knows else task_blind["angular_similarity"],
        "ceiling_acc": 1.0 if knows else task_blind["multilabel_accuracy"],
        "ceiling_freq": 1.0 if knows else task_blind["frequency_similarity"],
    }


def _typed(table: pd.DataFrame) -> pd.DataFrame:
    """Fill missing cells: text with "", counts with 0, numbers with NaN."""
    texts, counts = ["backbone", "weights"], ["n_folds", "n_seeds"]
    table[texts] = table[texts].fillna("")
    table[counts] = table[counts].fillna(0).astype(int)
    ends, starts = ("_mean", "_sd"), ("paper", "sim_over")
    numbers = [name for name in table if name.endswith(ends) or name.startswith(starts)]
    return table.astype(dict.fromkeys(numbers, float)).round(6)


def _over(constant: pd.DataFrame | None, group: pd.DataFrame) -> dict[str, float]:
    """A model's similarity minus that of a constant answer, paired by object.

    Args:
        constant: of :func:`grasptypes.predictors.ceilings.constant_of_others`; for None the
            result is empty.
        group: the model's rows of :data:`METRIC_SCHEMA`, grouped by the object left out.
    """
    if constant is None:
        return {}
    measure = "angular_similarity"
    by_object = group.groupby("group")[measure].mean()
    over = by_object - constant.loc[by_object.index, measure]
    return {"sim_over_constant": over.mean(), "sim_over_constant_se": over.sem()}


def _only(column: pd.Series) -> str:
    values = sorted(set(column))
    if len(values) != 1:
        raise ValueError(f"one table from different {column.name}: {', '.join(values)}")
    return str(values[0])
