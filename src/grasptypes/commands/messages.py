"""What commands say besides answers and errors, and the options that change how much it is."""

from __future__ import annotations

import argparse
import logging
import sys


def add_loudness(parser: argparse.ArgumentParser) -> None:
    """Add `--quiet` and `--verbose`: the level of what is logged, `loudness`."""
    choice = parser.add_mutually_exclusive_group()
    choice.add_argument(
        "-q",
        "--quiet",
        action="store_const",
        dest="loudness",
        const=logging.ERROR,
        default=logging.WARNING,
        help="no progress and no warnings, only errors",
    )
    choice.add_argument(
        "-v",
        "--verbose",
        action="store_const",
        dest="loudness",
        const=logging.INFO,
        default=logging.WARNING,
        help="also say details, such as which renderer is used",
    )


def say(line: str) -> None:
    """A line about progress or about what was left out, unless the user wants quiet."""
    if logging.getLogger("grasptypes").isEnabledFor(logging.WARNING):
        sys.stderr.write(f"{line}\n")
        sys.stderr.flush()
