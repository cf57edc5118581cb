"""What all workflow scripts share: a log file, and one line that says why a job failed."""

from __future__ import annotations

import errno
import logging
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from grasptypes.errors import InputError

# Errors of a file system that is full, read-only, or not ours to write.
_REFUSALS = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM)


@contextmanager
def job(log: Sequence[str]) -> Iterator[logging.Logger]:
    """Log to the rule's log file; report any error in one line and exit with status 1.

    An unexpected error also leaves its stack trace in the log.

    Args:
        log: the rule's log files (``snakemake.log``); the first one is used, or standard error
            if the list is empty.
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
        logging.raiseExceptions = False  # the log may be on the same full disk
        if line is None:
            line = " ".join(f"{type(error).__name__}: {error}".split())
            logger.info("unexpected error", exc_info=error)
        logger.error("%s", line)
        sys.stderr.write(f"error: {line}\n")
        sys.exit(1)
    finally:
        logging.shutdown()


def reason(error: Exception) -> str | None:
    """One line that explains an expected error; None for an unexpected one."""
    if isinstance(error, InputError):
        return str(error)
    if isinstance(error, OSError) and error.errno in _REFUSALS:
        return f"{error.filename or 'a file'}: {error.strerror}"
    # torch has no exception type of its own for this
    if isinstance(error, MemoryError) or "can't allocate memory" in str(error):
        return "not enough memory for this job: give it more, or run fewer at once (-j1)"
    return None
