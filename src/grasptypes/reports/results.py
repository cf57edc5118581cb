"""The tables of results: mean and spread over folds and seeds, beside paper and ceilings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.labels.samples import TYPES
from grasptypes.predictors.ceilings import ceilings, constant_of_others, labels_asked
from grasptypes.predictors.examples import Examples
from grasptypes.predictors.learning_inputs import BackboneRecord
from grasptypes.predictors.metrics import METRICS, evaluate
from grasptypes.predictors.predictor import VARIANTS
from grasptypes.predictors.training import Member

# Table I of the paper: similarity, accuracy, precision.
PAPER = {
    "no_task": (0.81, 0.85, 0.87),
    "task_vector": (0.90, 0.88, 0.88),
    "task_in_image": (0.92, 0.92, 0.92),
    "ignores_task": (0.94, 0.98, 0.99),
}
# Its row (e): MobileNetV2 of Zandigohar et al., arXiv:2101.05357 (their InceptionV3 has 0.95).
LITERATURE = ("literature", 0.93)
# The best constant answer for the joint labels of all tasks.
CONSTANT_JOINT = "best_constant_joint"
# The constant answer fitted to the other objects, by whether joint labels are asked for.
CONSTANT_OF_OTHERS = {False: "constant_of_others", True: "constant_of_others_joint"}
# Beginnings of the columns of a table, by measure.
SHORT = {
    "angular_similarity": "sim",
    "multilabel_accuracy": "acc",
    "multilabel_precision": "prec",
}

_SHARE = pa.Check.in_range(0, 1)
METRIC_SCHEMA = pa.DataFrameSchema(
    {
        "labels": pa.Column(str),
        "model": pa.Column(str, pa.Check.isin(list(VARIANTS))),
        "group": pa.Column(str),
        "seed": pa.Column(int, pa.Check.ge(0)),
        "n_train": pa.Column(int, pa.Check.gt(0)),
        "n_test": pa.Column(int, pa.Check.gt(0)),
        **{name: pa.Column(float, _SHARE) for name in METRICS},
        "backbone": pa.Column(str),
        "weights": pa.Column(str),
        "finetune": pa.Column(str),
    },
    strict=True,
    coerce=True,
    unique=["labels", "model", "group", "seed"],
)
CURVE_SCHEMA = pa.DataFrameSchema(
    {
        "group": pa.Column(str),
        "seed": pa.Column(int),
        "epoch": pa.Column(int, pa.Check.gt(0)),
        "train_loss": pa.Column(float),
        "test_loss": pa.Column(float, nullable=True),
    },
    strict=True,
    coerce=True,
)
PREDICTION_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "view": pa.Column(int),
        "task": pa.Column(str),
        "group": pa.Column(str),
        "seed": pa.Column(int),
        **{f"logit_{name}": pa.Column("float32") for name in TYPES},
    },
    strict=True,
)
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
        **{f"paper_{short}": pa.Column(float, nullable=True) for short in SHORT.values()},
        "ceiling_sim": pa.Column(float, _SHARE, nullable=True),
        "ceiling_acc": pa.Column(float, _SHARE, nullable=True),
        "sim_over_constant": pa.Column(float, pa.Check.in_range(-1, 1), nullable=True),
        "sim_over_constant_se": pa.Column(float, pa.Check.ge(0), nullable=True),
    },
    strict=True,
)


def score(
    examples: Examples, members: Sequence[Member], logits: Sequence[np.ndarray]
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Metrics, one row a member; and predictions, one row a member and test example.

    Args:
        logits: for each member (m, types) of its test examples.
    """
    metrics, predictions = [], []
    for member, outputs in zip(members, logits, strict=True):
        name = {"group": member.group, "seed": member.seed}
        sizes = {"n_train": len(member.train), "n_test": len(member.test)}
        rows = member.test
        values = evaluate(outputs, examples.labels[rows], examples.probabilities[rows])
        metrics.append(name | sizes | values)
        numbers = pd.DataFrame(outputs, columns=[f"logit_{t}" for t in TYPES], dtype=np.float32)
        where = examples.index.iloc[rows][["object", "view", "task"]].reset_index(drop=True)
        predictions.append(pd.concat([where.assign(**name), numbers], axis=1))
    return pd.DataFrame(metrics), pd.concat(predictions, ignore_index=True)


def with_source(
    metrics: pd.DataFrame, name: tuple[str, str], backbone: BackboneRecord, finetune: str
) -> pd.DataFrame:
    """Metrics of :func:`score` as a table of :data:`METRIC_SCHEMA`: what they are made from.

    Args:
        name: label source and model.
    """
    source = {"labels": name[0], "model": name[1]}
    used = {"backbone": backbone.backbone, "weights": backbone.weights, "finetune": finetune}
    return metrics.assign(**source, **used)[list(METRIC_SCHEMA.columns)]


def curve_table(members: Sequence[Member], curves: np.ndarray) -> pd.DataFrame:
    """Loss curves (epochs, members, 2) as a table of :data:`CURVE_SCHEMA`."""
    return pd.concat(
        [
            pd.DataFrame(
                {
                    "group": member.group,
                    "seed": member.seed,
                    "epoch": np.arange(1, len(curves) + 1),
                    "train_loss": curves[:, number, 0],
                    "test_loss": curves[:, number, 1],
                }
            )
            for number, member in enumerate(members)
        ],
        ignore_index=True,
    )


def tabulate(
    metrics: pd.DataFrame, samples: pd.DataFrame, labels: str, unseen: bool = False
) -> pd.DataFrame:
    """The rows of Table I, or of Table II on unseen objects, for one label source.

    ``ceiling_*`` is what the row's model could reach with perfect recognition of the object: the
    task-blind ceiling for the model that does not know the task, 1 for the others.
    ``sim_over_constant`` is the similarity on an unseen object over that of the constant answer
    fitted to the other objects, mean and standard error over the objects left out (paired). The
    reference predictors and the literature stand in rows of their own; the model that ignores the
    task is asked for joint labels, so that it has constant answers of its own.

    Args:
        metrics: rows of :data:`METRIC_SCHEMA`, all of these labels.
        samples: the label source's table of :mod:`grasptypes.labels.samples`.
        labels: its name.
        unseen: the groups are objects left out of training. The paper and the literature measured
            none: their columns stay empty. Else those of ``sim_over_constant`` do.

    Returns:
        a table of :data:`RESULT_SCHEMA`.
    """
    reference = ceilings(labels_asked(samples, joint=False))
    joint_reference = ceilings(labels_asked(samples, joint=True))
    reference.loc[CONSTANT_JOINT] = joint_reference.loc["best_constant"]
    constants = {
        joint: constant_of_others(samples, joint) for joint in CONSTANT_OF_OTHERS if unseen
    }
    for joint, scores in constants.items():
        reference.loc[CONSTANT_OF_OTHERS[joint]] = scores.mean()
    blind = reference.loc["task_blind"]
    rows = []
    for model, group in metrics.groupby("model"):
        knows = model != "no_task"
        constant = constants.get(VARIANTS[str(model)].joint_labels)
        paper = {} if unseen else dict(zip(SHORT.values(), PAPER[str(model)], strict=True))
        rows.append(
            {"model": model, "labels": labels}
            | {key: _only(group[key]) for key in ("backbone", "weights")}
            | {f"{short}_mean": group[name].mean() for name, short in SHORT.items()}
            | {f"{short}_sd": group[name].std() for name, short in SHORT.items()}
            | {"n_folds": group["group"].nunique(), "n_seeds": group["seed"].nunique()}
            | {f"paper_{short}": value for short, value in paper.items()}
            | {"ceiling_sim": 1.0 if knows else blind["angular_similarity"]}
            | {"ceiling_acc": 1.0 if knows else blind["multilabel_accuracy"]}
            | ({} if constant is None else _over(constant, group))
        )
    rows.sort(key=lambda row: list(VARIANTS).index(row["model"]))
    for name in reference.index:
        values = {f"{short}_mean": reference.loc[name, long] for long, short in SHORT.items()}
        rows.append({"model": name, "labels": labels} | values)
    if not unseen:
        rows.append({"model": LITERATURE[0], "labels": "", "paper_sim": LITERATURE[1]})
    table = pd.DataFrame(rows, columns=list(RESULT_SCHEMA.columns))
    texts, counts = ["backbone", "weights"], ["n_folds", "n_seeds"]
    table[texts] = table[texts].fillna("")
    table[counts] = table[counts].fillna(0).astype(int)
    ends, starts = ("_mean", "_sd"), ("paper", "sim_over")
    numbers = [name for name in table if name.endswith(ends) or name.startswith(starts)]
    table[numbers] = table[numbers].astype(float)
    return table.round(6)


def constant_rows(table: pd.DataFrame, labels: str) -> pd.DataFrame:
    """For each trained model the row of the constant answer of the others to what it is asked.

    Args:
        table: of :data:`RESULT_SCHEMA`, on unseen objects.

    Returns:
        index model, columns those of the table.
    """
    rows = table[table["labels"] == labels].set_index("model")
    models = rows.index[rows["n_folds"] > 0]
    named = [CONSTANT_OF_OTHERS[VARIANTS[model].joint_labels] for model in models]
    return rows.loc[named].set_axis(models)


def _over(constant: pd.DataFrame, group: pd.DataFrame) -> dict[str, float]:
    """A model's similarity over that of a constant answer, paired by object.

    Args:
        constant: of :func:`grasptypes.predictors.ceilings.constant_of_others`.
        group: the model's rows of :data:`METRIC_SCHEMA`, their groups being objects left out.
    """
    measure = "angular_similarity"
    by_object = group.groupby("group")[measure].mean()
    over = by_object - constant.loc[by_object.index, measure]
    return {"sim_over_constant": over.mean(), "sim_over_constant_se": over.sem()}


def _only(column: pd.Series) -> str:
    values = sorted(set(column))
    if len(values) != 1:
        raise ValueError(f"one table from different {column.name}: {', '.join(values)}")
    return str(values[0])
