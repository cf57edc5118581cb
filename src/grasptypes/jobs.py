"""What every workflow script shares: a log file, and one clear line for bad input."""

from __future__ import annotations

import logging
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from grasptypes.errors import InputError


@contextmanager
def job(log: Sequence[str]) -> Iterator[logging.Logger]:
    """Log to the rule's log file, and turn an :class:`InputError` into one line and exit status 1.

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
        logger.error("%s", error)
        sys.stderr.write(f"error: {error}\n")
        sys.exit(1)
    finally:
        logging.shutdown()
