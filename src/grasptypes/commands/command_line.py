"""The command line: ``grasptypes predict`` and the other commands of ``grasptypes --help``."""

from __future__ import annotations

import argparse
import logging
import os
import sys
import warnings
from collections.abc import Sequence
from concurrent.futures.process import BrokenProcessPool
from copy import copy
from importlib.metadata import version
from typing import NoReturn

from grasptypes.commands import demo, hand, inspect, label, plan, predict, view
from grasptypes.commands.messages import add_loudness
from grasptypes.errors import InputError, InputErrors
from grasptypes.extras import MissingExtraError, missing_extra

COMMANDS = {
    "predict": predict,
    "plan": plan,
    "inspect": inspect,
    "label": label,
    "view": view,
    "demo": demo,
    "hand": hand,
}


class _Parser(argparse.ArgumentParser):
    """Reports errors in the arguments in one line."""

    def error(self, message: str) -> NoReturn:
        """Exit with status 2."""
        self.exit(2, f"error: {message} (see {self.prog} --help)\n")


class _Version(argparse.Action):
    """Prints the version; only then is the package's metadata looked up."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        """Exit with status 0."""
        sys.stdout.write(f"grasptypes {version('grasptypes')}\n")
        parser.exit()


class _Completion(argparse.Action):
    """Prints the script by which a shell completes commands and options."""

    def __call__(
        self, parser: argparse.ArgumentParser, _: object, shell: object, *__: object
    ) -> NoReturn:
        """Exit with status 0."""
        import shtab

        sys.stdout.write(shtab.complete(parser, str(shell)) + "\n")
        parser.exit()


def parser() -> argparse.ArgumentParser:
    """All commands and their options."""
    whole = _Parser("grasptypes", description="Which grasp should a robot hand use?")
    whole.add_argument("--version", action=_Version, nargs=0, help="print the version")
    whole.add_argument(
        "--print-completion",
        action=_Completion,
        choices=("bash", "zsh", "tcsh"),
        help="print the script by which a shell completes commands and options",
    )
    commands = whole.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, module in COMMANDS.items():
        command = commands.add_parser(
            name, help=module.SUMMARY, description=module.SUMMARY, allow_abbrev=False
        )
        module.add_arguments(command)
        add_loudness(command)
    return whole


class _LowerCase(logging.Formatter):
    """Names of levels as in the commands' own lines: `warning: ...`."""

    def format(self, record: logging.LogRecord) -> str:
        """A line of a record, which stays as it is for other handlers."""
        lower = copy(record)
        lower.levelname = record.levelname.lower()
        return super().format(lower)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run one command.

    Bad input, a full disk and lack of memory are reported in one line with exit status 1; Ctrl-C
    exits with 130, a closed pipe with 141, as in shells.
    """
    args = parser().parse_args(arguments)
    shown = logging.StreamHandler()
    shown.setFormatter(_LowerCase("%(levelname)s: %(message)s"))
    logging.basicConfig(level=logging.ERROR, handlers=[shown])
    logging.getLogger("grasptypes").setLevel(args.loudness)
    logging.getLogger("PIL").setLevel(logging.CRITICAL)  # its errors about images are raised, too
    warnings.simplefilter("ignore")
    try:
        sys.stdout.write(COMMANDS[args.command].run(args))
        sys.stdout.flush()
    except InputError as error:
        sys.exit(f"error: {error}")
    except InputErrors as several:
        sys.exit("\n".join(f"error: {error}" for error in several.errors))
    except BrokenPipeError:  # the reader, such as `head`, has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(141)
    except MissingExtraError as error:
        sys.exit(f"error: {error}")
    except ModuleNotFoundError as error:
        sys.exit(f"error: {missing_extra(error, args.command)}")
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        sys.exit(f"error: {where}{error.strerror or error}")
    except (MemoryError, BrokenProcessPool):  # the system kills a process that needs too much
        sys.exit("error: not enough memory: close other programs, or plan with --jobs 1")
    except KeyboardInterrupt:
        sys.exit(130)
