"""Table III: answers about unseen objects next to labels, with standard errors over objects."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.labels.samples import COUNTS, LABELS
from grasptypes.predictors.general_protocol import (
    COLUMNS,
    CONSTANT,
    DIRECTION,
    OBJECTS,
    OCCURS,
    ROWS,
    SHARES,
)
from grasptypes.predictors.metrics import (
    SIGMOID_THRESHOLD,
    angular_similarity,
    multilabel_accuracy,
    multilabel_precision,
)

MEASURES = ("similarity", "similarity_shares", "accuracy", "precision")
# Column of the objects whose labels no number of the project was fitted to.
UNFITTED = "objects_unfitted"

_SHARE = pa.Check.in_range(0, 1)
TABLE_SCHEMA = pa.DataFrameSchema(
    {
        "shown": pa.Column(str, pa.Check.isin([*COLUMNS, UNFITTED])),
        "labels": pa.Column(str, description="compared with"),
        "model": pa.Column(str, pa.Check.isin(ROWS)),
        "learned_from": pa.Column(str, description="labels of the objects learned from"),
        "n_objects": pa.Column(int, pa.Check.ge(1)),
        **{
            f"{name}{part}": pa.Column(float, check, nullable=bool(part))
            for name in MEASURES
            for part, check in (("", _SHARE), ("_se", pa.Check.ge(0)))
        },
        "calibration_error": pa.Column(float, _SHARE),
        "over_constant": pa.Column(float, pa.Check.in_range(-1, 1), description="of similarity"),
        "over_constant_se": pa.Column(float, pa.Check.ge(0), nullable=True, description="paired"),
    },
    strict=True,
    ordered=True,
    unique=["shown", "labels", "model", "learned_from"],
)


def tabulate(
    answers: pd.DataFrame,
    samples: Mapping[str, pd.DataFrame],
    unfitted: Collection[str],
    bins: int,
) -> pd.DataFrame:
    """A row per column of the issue's table, label source and model: a table of `TABLE_SCHEMA`.

    Similarity is that of the direction with the set of types, `similarity_shares` that of the
    shares with the frequencies. Views and tasks of an object are averaged first; errors are
    standard errors over objects.

    Args:
        answers: of `general_protocol.ANSWER_SCHEMA`.
        samples: by label source.
        unfitted: objects with a column of their own.
        bins: of the expected calibration error.
    """
    rows = []
    own = answers[(answers["shown"] == OBJECTS) & answers["object"].isin(unfitted)]
    everything = pd.concat([answers, own.assign(shown=UNFITTED)], ignore_index=True)
    for source, labels in samples.items():
        scored = score(everything, labels)
        # What can learn from several sources is compared with the one it learned from.
        several = scored.groupby("model")["labels"].transform("nunique") > 1
        scored = scored[~several | (scored["labels"] == source)]
        for shown, group in scored.groupby("shown", sort=False):
            means = object_means(group)
            constant = means.loc[CONSTANT].droplevel(0)["similarity"]
            for (model, learned), part in group.groupby(["model", "labels"], sort=False):
                mine = means.loc[(model, learned)]
                rows.append(
                    {"shown": shown, "labels": source, "model": model, "learned_from": learned}
                    | {"n_objects": len(mine)}
                    | _spread(mine)
                    | {"calibration_error": calibration_error(part, bins)}
                    | _over(mine["similarity"], constant)
                )
    table = pd.DataFrame(rows)
    order = {name: place for place, name in enumerate([*COLUMNS, UNFITTED, *ROWS, *samples])}
    keys = ["shown", "labels", "model"]
    table = table.sort_values(keys, key=lambda column: column.map(order), kind="stable")
    return table[list(TABLE_SCHEMA.columns)].round(6).reset_index(drop=True)


def score(answers: pd.DataFrame, samples: pd.DataFrame) -> pd.DataFrame:
    """The answers that have a label, with their measures and the label's columns."""
    wanted = samples[["object", "task", *LABELS, *COUNTS]]
    found = answers.merge(wanted, on=["object", "task"])
    occurs, labels = found[list(OCCURS)].to_numpy(), found[list(LABELS)].to_numpy()
    types = occurs > SIGMOID_THRESHOLD
    return found.assign(
        similarity=angular_similarity(found[list(DIRECTION)], labels),
        similarity_shares=angular_similarity(found[list(SHARES)], found[list(COUNTS)]),
        accuracy=multilabel_accuracy(types, labels),
        precision=multilabel_precision(types, labels),
    )


def calibration_error(scored: pd.DataFrame, bins: int) -> float:
    """Expected calibration error: how far probabilities are from frequencies, in equal bins.

    Every type of every answer counts. Guo et al. 2017, "On calibration of modern neural networks".
    """
    curve = calibration_curve(scored, bins)
    gap = (curve["predicted"] - curve["observed"]).abs()
    return float((gap * curve["count"]).sum() / curve["count"].sum())


def calibration_curve(scored: pd.DataFrame, bins: int) -> pd.DataFrame:
    """Mean probability, frequency and number of types in each bin that has any."""
    chance = scored[list(OCCURS)].to_numpy().ravel()
    occurs = scored[list(LABELS)].to_numpy().ravel()
    place = np.minimum((chance * bins).astype(int), bins - 1)
    table = pd.DataFrame({"bin": place, "predicted": chance, "observed": occurs})
    return table.groupby("bin").agg(
        predicted=("predicted", "mean"), observed=("observed", "mean"), count=("observed", "size")
    )


def object_means(scored: pd.DataFrame) -> pd.DataFrame:
    """Means of views, then tasks: index model, labels, object."""
    keys = ["model", "labels", "object"]
    return scored.groupby([*keys, "task"])[list(MEASURES)].mean().groupby(keys).mean()


def _spread(means: pd.DataFrame) -> dict[str, float]:
    """Mean over objects and its standard error, of every measure."""
    return {
        key: value
        for name in MEASURES
        for key, value in ((name, means[name].mean()), (f"{name}_se", means[name].sem()))
    }


def _over(mine: pd.Series, constant: pd.Series) -> dict[str, float]:
    """Mean difference to the constant answer, and its standard error over objects."""
    difference = mine - constant.reindex(mine.index)
    return {"over_constant": difference.mean(), "over_constant_se": difference.sem()}


def markdown(table: pd.DataFrame) -> str:
    """The table as Markdown: similarity ± standard error, and the other measures beside it."""
    heads = ["shown", "labels", "model", "similarity", "over constant", "shares", "accuracy"]
    heads += ["precision", "calibration error"]
    lines = [" | ".join(heads), " | ".join("---" for _ in heads)]
    for row in table.itertuples():
        learned = "" if row.learned_from == row.labels else f" ({row.learned_from})"
        lines.append(
            f"{row.shown} | {row.labels} | {row.model}{learned} | "
            f"{row.similarity:.3f} ± {row.similarity_se:.3f} | "
            f"{row.over_constant:+.3f} ± {row.over_constant_se:.3f} | "
            f"{row.similarity_shares:.3f} | {row.accuracy:.3f} | {row.precision:.3f} | "
            f"{row.calibration_error:.3f}"
        )
    note = "±: standard error over objects, paired in the column *over constant*."
    return "\n".join(f"| {line} |" for line in lines) + f"\n\n{note}\n"
