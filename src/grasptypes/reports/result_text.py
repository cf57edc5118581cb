"""The tables of results as Markdown."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pandas as pd

from grasptypes.predictors.scoring import SHORT
from grasptypes.reports.results import PAPER_COLUMNS, UNTRAINED

FREQUENCIES = (
    "frequencies: angular similarity to how often each type occurs; similarity gives the same "
    "probability to all types that occur. Models with e_ learn the frequencies of both tasks "
    f"together. {UNTRAINED} has no values: its weights could not be obtained."
)


def markdown(table: pd.DataFrame) -> str:
    """A table of :data:`RESULT_SCHEMA` as Markdown, mean ± spread in one cell.

    Without figures from the paper, their column is replaced by a sentence that compares the models
    with the constant answer fitted to the other objects.
    """
    paper = table[list(PAPER_COLUMNS)].notna().any(axis=None)
    heads = ["model", "labels", "similarity", "accuracy", "precision", "frequencies"]
    heads += ["paper", "ceiling"] if paper else ["ceiling"]
    lines = [" | ".join(heads), " | ".join("---" for _ in heads)]
    for row in table.to_dict("records"):
        cells = [row["model"], row["labels"]]
        cells += [_spread(row[f"{s}_mean"], row[f"{s}_sd"]) for s in SHORT.values()]
        if paper:
            cells.append(_joined(row[name] for name in PAPER_COLUMNS))
        cells.append(_joined(row[f"ceiling_{short}"] for short in ("sim", "acc", "freq")))
        lines.append(" | ".join(cells))
    used = table[table["n_folds"] > 0]
    note = "; ".join(
        f"{labels}: {backbone}, {weights}, {folds} groups x {seeds} seeds"
        for labels, backbone, weights, folds, seeds in used[
            ["labels", "backbone", "weights", "n_folds", "n_seeds"]
        ]
        .drop_duplicates()
        .itertuples(index=False)
    )
    over = "folds and seeds" if paper else "objects left out, repetitions averaged"
    spread = f"± in the table: standard deviation over {over}."
    rows = "\n".join(f"| {line} |" for line in lines)
    paragraphs = [rows, note, spread, FREQUENCIES]
    return "\n\n".join(paragraphs if paper else [*paragraphs, beside_constant(table)]) + "\n"


def beside_constant(table: pd.DataFrame) -> str:
    """Similarity of the models minus that of the constant of the others, one line per source.

    Args:
        table: of :data:`RESULT_SCHEMA`, on unseen objects.
    """
    sentences = []
    for labels, rows in table[table["n_folds"] > 0].groupby("labels", sort=False):
        differences = ", ".join(
            f"{row.model} {row.sim_over_constant:+.3f} ± {row.sim_over_constant_se:.3f}"
            for row in rows.itertuples()
        )
        sentences.append(
            f"{labels}: similarity on the object left out less that of the constant answer fitted "
            f"to the other objects, mean ± standard error over {rows['n_folds'].max()} objects: "
            f"{differences}."
        )
    sentences.append(
        "constant_of_others is fitted to the labels that a model is trained on; best_constant to "
        "those of all objects, the one left out among them. Both give one answer to every object "
        "and task, each measure its own best one; those to the models that are asked for the "
        "types of all tasks together (ignores_task and those with e_) are the rows in _joint."
    )
    return "\n\n".join(sentences)


def _spread(mean: float, deviation: float) -> str:
    if np.isnan(mean):
        return ""
    return f"{mean:.3f}" if np.isnan(deviation) else f"{mean:.3f} ± {deviation:.3f}"


def _joined(values: Iterable[float]) -> str:
    return " / ".join(
        f"{value:.2f}" if value == round(value, 2) else f"{value:.3f}"
        for value in values
        if not np.isnan(value)
    )
