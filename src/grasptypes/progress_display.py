"""The time left in the display of ``snakemake --logger rich``, which shows the time passed only."""

from __future__ import annotations

from collections.abc import Iterable

from rich.progress import Progress, TimeRemainingColumn

# Jobs take seconds to minutes, so their pace is that of the last minutes, in seconds.
PACE_S = 600.0


def show_time_left(handlers: Iterable[object]) -> None:
    """Add a column with the time left to each display of progress among the handlers of a log.

    The estimate is the pace of finished jobs, whatever their rule: a rough one.
    """
    for handler in handlers:
        progress = getattr(handler, "progress", None)
        if isinstance(progress, Progress):
            progress.columns = (*progress.columns, "left", TimeRemainingColumn())
            progress.speed_estimate_period = PACE_S
