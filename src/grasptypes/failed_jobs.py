"""One line per failed job, printed at the end of a run."""

from __future__ import annotations

import logging
from pathlib import Path

from snakemake.logging import logger
from snakemake_interface_logger_plugins.common import LogEvent

# Prefix of a job's last error in its log; see grasptypes.jobs.
ERROR = "ERROR "


class FailedJobs(logging.Handler):
    """Collects the failed jobs that Snakemake reports."""

    def __init__(self) -> None:
        super().__init__()
        self.logs: dict[str, Path] = {}
        logger.addHandler(self)

    def emit(self, record: logging.LogRecord) -> None:
        """Keep the name and the log of a job that failed."""
        if getattr(record, "event", None) == LogEvent.JOB_ERROR:
            log = Path(record.__dict__["log"][0])
            self.logs[str(log.with_suffix("").relative_to("logs"))] = log

    def summary(self) -> str:
        """One line per job: rule, wildcards, reason, and log."""
        return "".join(
            f"error: {job}: {_reason(log)} (log: {log})\n" for job, log in self.logs.items()
        )


def _reason(log: Path) -> str:
    """The last error in a log; a killed job leaves none."""
    lines = log.read_text(errors="replace").splitlines() if log.is_file() else []
    reasons = [line for line in lines if line.startswith(ERROR)]
    if not reasons:
        return "ended without a message, as if killed (was there enough memory?)"
    return reasons[-1].removeprefix(ERROR)
