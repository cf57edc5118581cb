"""Whether probabilities of grasp types are frequencies, for the rows of Table III."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd
from matplotlib.figure import Figure

from grasptypes.predictors.general_protocol import (
    CONSTANT,
    KINDS,
    OBJECTS,
    SIMULATED,
    TASK_VECTOR,
    VIEWS,
    VIEWS_WITH_SIZE,
)
from grasptypes.reports.table3 import calibration_curve, calibration_error, score

SHOWN = {CONSTANT: "#6c757d", TASK_VECTOR: "#c9a227", VIEWS: "#2a6f97", VIEWS_WITH_SIZE: "#b23a48"}


def draw_calibration(
    answers: pd.DataFrame, samples: Mapping[str, pd.DataFrame], bins: int
) -> Figure:
    """Frequency of a type against its probability, for held-out kinds and for held-out objects.

    Args:
        answers: of `general_protocol.ANSWER_SCHEMA`.
        samples: by label source.
        bins: of the probabilities.
    """
    panels = [(KINDS, SIMULATED), *((OBJECTS, source) for source in samples)]
    figure = Figure(figsize=(4.2 * len(panels), 4.4))
    for axes, (shown, source) in zip(
        figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True
    ):
        rows = answers[answers["shown"] == shown]
        scored = score(rows[rows["labels"].isin([SIMULATED, source])], samples[source])
        axes.plot([0, 1], [0, 1], color="black", linewidth=0.8, linestyle=":")
        for model, colour in SHOWN.items():
            mine = scored[scored["model"] == model]
            mine = mine[mine["labels"] == (source if model == TASK_VECTOR else SIMULATED)]
            if len(mine):
                curve = calibration_curve(mine, bins)
                label = f"{model}: error {calibration_error(mine, bins):.3f}"
                axes.plot(curve["predicted"], curve["observed"], "o-", color=colour, label=label)
        axes.set_title(f"held-out {shown}, {source} labels", fontsize=10)
        axes.set_xlabel("probability that a type occurs")
        axes.set_ylabel("how often it does")
        axes.legend(fontsize=8, loc="lower right")
    figure.tight_layout()
    return figure
