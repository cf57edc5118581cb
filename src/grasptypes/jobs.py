"""What every workflow script shares: a log file, and one clear line for bad input."""

from __future__ import annotations

import errno
import logging
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

from grasptypes.errors import InputError

# What a file system answers when it is full, read-only, or somebody else's.
_REFUSALS = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM)


@contextmanager
def job(log: Sequence[str]) -> Iterator[logging.Logger]:
    """Log to the rule's log file, and end with one line and exit status 1 where that says it all.

    It does for an :class:`InputError`, a disk that takes nothing, and memory that is too short.

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
    except InputError as error:
        _end(logger, str(error))
    except OSError as error:
        if error.errno not in _REFUSALS:
            raise
        _end(logger, f"{error.filename or 'a file'}: {error.strerror}")
    except (MemoryError, RuntimeError) as error:
        if not isinstance(error, MemoryError) and "can't allocate memory" not in str(error):
            raise  # torch has no type of its own for that
        _end(
            logger, "the memory is too short for this job: give it more, or run fewer at once (-j1)"
        )
    finally:
        logging.shutdown()


def _end(logger: logging.Logger, line: str) -> NoReturn:
    logging.raiseExceptions = False  # the log may lie on the same full disk
    logger.error("%s", line)
    sys.stderr.write(f"error: {line}\n")
    sys.exit(1)
