"""What every workflow script shares: a log file, and one line that says why a job failed."""

from __future__ import annotations

import errno
import logging
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from grasptypes.errors import InputError

# What a file system answers when it is full, read-only, or somebody else's.
_REFUSALS = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM)


@contextmanager
def job(log: Sequence[str]) -> Iterator[logging.Logger]:
    """Log to the rule's log file; whatever goes wrong ends with one line and exit status 1.

    An error that nobody foresaw also leaves its stack trace in the log.

    Args:
        log: the rule's log files (``snakemake.log``); the first is used, an empty list means
            standard error only.
    """
    handlers: list[logging.Handler] = [logging.StreamHandler(sys.stderr)]
    if len(log) > 0:
        Path(log[0]).parent.mkdir(parents=True, exist_ok=True)
        handlers = [logging.FileHandler(log[0], mode="w")]
    logging.basicConfig(
        level=logging.INFO, format="%(levelname)s %(message)s", handlers=handlers, force=True
    )
    logger = logging.getLogger("grasptypes")
    try:
        yield logger
    except Exception as error:
        line = reason(error)
        logging.raiseExceptions = False  # the log may lie on the same full disk
        if line is None:
            line = " ".join(f"{type(error).__name__}: {error}".split())
            logger.info("unexpected error", exc_info=error)
        logger.error("%s", line)
        sys.stderr.write(f"error: {line}\n")
        sys.exit(1)
    finally:
        logging.shutdown()


def reason(error: Exception) -> str | None:
    """One line that says it all; None for an error that nobody foresaw."""
    if isinstance(error, InputError):
        return str(error)
    if isinstance(error, OSError) and error.errno in _REFUSALS:
        return f"{error.filename or 'a file'}: {error.strerror}"
    # torch has no type of its own for lack of memory
    if isinstance(error, MemoryError) or "can't allocate memory" in str(error):
        return "not enough memory for this job: give it more, or run fewer at once (-j1)"
    return None
