"""Trials of the predictor for unseen objects: one setting at a time, on kinds that are held out."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import replace

import pandas as pd
import pandera.pandas as pa
from matplotlib.figure import Figure

from grasptypes.predictors.families import family_folds
from grasptypes.predictors.general_examples import Known
from grasptypes.predictors.general_inputs import Pictures, spread_of
from grasptypes.predictors.general_protocol import (
    CONSTANT,
    KINDS,
    SIMULATED,
    SIZE_ONLY,
    VIEWS,
    VIEWS_WITH_SIZE,
    Heads,
    answers,
    finished,
    hold_out_images,
)
from grasptypes.reports.table3 import TABLE_SCHEMA, tabulate
from grasptypes.seeds import rng
from grasptypes.settings.general import BACKBONE, GeneralSettings
from grasptypes.settings.general import KINDS as KINDS_TRIAL

LOGGER = logging.getLogger("grasptypes")
CURVES = {
    CONSTANT: "#6c757d",
    SIZE_ONLY: "#c9a227",
    VIEWS: "#2a6f97",
    VIEWS_WITH_SIZE: "#b23a48",
}
COLUMNS = ("model", "similarity", "similarity_se", "similarity_shares", "calibration_error")
TRIAL_SCHEMA = pa.DataFrameSchema(
    {
        "shown": TABLE_SCHEMA.columns["shown"],
        "setting": pa.Column(str, description="of the head, or the number of kinds"),
        "value": pa.Column(str, coerce=True),
        "learned": pa.Column(float, description="shapes learned from, mean over the folds"),
        **{name: TABLE_SCHEMA.columns[name] for name in COLUMNS},
        "over_constant": TABLE_SCHEMA.columns["over_constant"],
        "over_constant_se": TABLE_SCHEMA.columns["over_constant_se"],
    },
    strict=True,
    ordered=True,
    unique=["shown", "setting", "value", "model"],
)


def try_settings(
    known: Known, others: Mapping[str, Pictures], settings: GeneralSettings, seed: int
) -> pd.DataFrame:
    """One row per trial and model: a table of `TRIAL_SCHEMA`.

    Args:
        known: kinds, each of which is held out once, with its family.
        others: the same images as other backbones see them.
    """
    tables = []
    for key, values in settings.trials.items():
        for value in values:
            pictures = others[str(value)] if key == BACKBONE else known.pictures
            seen = replace(known, pictures=pictures.of(known.facts.index))
            table = _try(seen, settings, (key, value), seed)
            tables.append(table.assign(setting=key, value=str(value)))
            LOGGER.info("tried %s: %s", key, value)
    return pd.concat(tables, ignore_index=True)[list(TRIAL_SCHEMA.columns)]


def _try(
    known: Known, settings: GeneralSettings, trial: tuple[str, float | str], seed: int
) -> pd.DataFrame:
    """The rows of one trial."""
    head, count = settings.trial(*trial)
    folds, learned = [], []
    for fold in family_folds(known.families, settings.protocol.folds, seed):
        test = known.only([name for name in known.facts.index if known.families[name] & fold])
        left = known.without(fold)
        if count:
            left = left.only(_drawn(list(left.facts.index), count, seed))
        learned.append(len(left.facts))
        heads = Heads.of(left, head)
        folds.append(answers(heads, test.pictures, test.facts, known.tasks))
    told = [finished(pd.concat(folds, ignore_index=True), KINDS, SIMULATED)]
    if not count:
        other = spread_of(settings.protocol.size_spread, settings.protocol.mass_spread)
        told.append(hold_out_images(known, head, other, seed))
    table = tabulate(
        pd.concat(told, ignore_index=True), {SIMULATED: known.samples}, [], settings.protocol.bins
    )
    return table.assign(learned=sum(learned) / len(learned))


def _drawn(names: list[str], count: int, seed: int) -> list[str]:
    """`count` of the names; more of them contain fewer."""
    return sorted(names, key=lambda name: rng("kinds learned", name, seed).random())[:count]


def draw_curve(table: pd.DataFrame) -> Figure:
    """Similarity on held-out kinds against the number of shapes learned from.

    Args:
        table: of `TRIAL_SCHEMA`, with trials of the number of kinds.
    """
    rows = table[(table["setting"] == KINDS_TRIAL) & (table["shown"] == KINDS)]
    figure = Figure(figsize=(6.4, 4.2), layout="constrained")
    axes = figure.subplots()
    for model, colour in CURVES.items():
        mine = rows[rows["model"] == model].sort_values("learned")
        axes.errorbar(
            mine["learned"],
            mine["similarity"],
            mine["similarity_se"],
            fmt="o-",
            color=colour,
            capsize=3,
            label=model,
        )
    counts = sorted(set(rows["learned"]))
    axes.set_xscale("log")
    axes.set_xticks(counts, [f"{count:.0f}" for count in counts])
    axes.minorticks_off()
    axes.set_xlabel("kinds learned from")
    axes.set_ylabel("angular similarity, held-out kinds")
    axes.legend(fontsize="small")
    return figure
