"""What became of the jobs that failed: one line each, after everything else is said."""

from __future__ import annotations

import logging
from pathlib import Path

from snakemake.logging import logger
from snakemake_interface_logger_plugins.common import LogEvent

# How a job's log tells why it ended; see grasptypes.jobs.
ERROR = "ERROR "


class FailedJobs(logging.Handler):
    """Listens to Snakemake for jobs that fail."""

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
        """A line for each job: its rule, its wildcards, and the reason."""
        return "".join(f"error: {job}: {_reason(log)}\n" for job, log in self.logs.items())


def _reason(log: Path) -> str:
    """The last error of a log; a job that was killed leaves none."""
    lines = log.read_text(errors="replace").splitlines() if log.is_file() else []
    reasons = [line for line in lines if line.startswith(ERROR)]
    if not reasons:
        return f"ended without a message, as if killed (was there enough memory?); see {log}"
    return reasons[-1].removeprefix(ERROR)
