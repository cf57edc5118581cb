"""Shared by the commands: options, printable names, and checks of output paths."""

from __future__ import annotations

import argparse
import errno
import sys
import tempfile
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

from grasptypes.commands.messages import say
from grasptypes.errors import InputError

if TYPE_CHECKING:  # other commands need no server
    from http.server import HTTPServer


def printable(name: str) -> str:
    """A file name that can be printed: "?" replaces characters that are not visible."""
    return "".join(letter if letter.isprintable() else "?" for letter in name)


def add_folder(parser: argparse.ArgumentParser) -> None:
    """Add the option that names the checkout."""
    parser.add_argument(
        "--folder",
        type=Path,
        help="checkout whose params.yaml and models are used (default: the current folder; "
        "if it has no params.yaml, the parameters that come with the package)",
    )


def add_page(parser: argparse.ArgumentParser) -> None:
    """Add the options of a page in the browser."""
    parser.add_argument("--port", type=_port, default=0, help="port of the page (default: any)")
    parser.add_argument("--no-browser", action="store_true", help="print the address only")


def serve(server: HTTPServer, what: str, args: argparse.Namespace) -> None:
    """Say where a page is, show it unless `--no-browser` is given, and serve it until Ctrl-C.

    Args:
        what: is served; before the address.
    """
    address = f"http://127.0.0.1:{server.server_address[1]}/"
    sys.stdout.write(f"{what}{address} until Ctrl-C\n")
    sys.stdout.flush()
    if not args.no_browser:
        import webbrowser

        webbrowser.open(address)
    server.serve_forever()


def _port(text: str) -> int:
    if not text.isdecimal() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text} is not a port (0 to 65535)")
    return int(text)


def read_task(text: str, known: Collection[str]) -> str:
    """The known task that --task names, by name or in words; says on stderr how words are taken.

    Raises:
        InputError: the text names no known task, or several equally.
    """
    from grasptypes.settings.task_words import find_task

    task = find_task(text, known)
    if task != text:
        say(f"task: {task}")
    return task


def check_target(path: Path, suffix: str) -> None:
    """Reject a file that cannot be written, before anything is computed.

    Raises:
        InputError: a wrong suffix, a folder, or a place that is not writable.
    """
    if path.suffix.lower() != suffix:
        raise InputError(path, "", f"must end in {suffix}")
    if path.is_dir():
        raise InputError(path, "", "is a folder")
    check_place(path)


def check_place(path: Path) -> None:
    """Reject a file or folder that cannot be created, by a trial that leaves nothing behind.

    Raises:
        InputError: the nearest existing parent folder is not writable, or a name is too long.
    """
    from grasptypes.files import staging_name

    above = Path()
    try:
        above = next(parent for parent in path.parents if parent.exists())
        with tempfile.TemporaryDirectory(dir=above) as trial:
            for name in path.parts[len(above.parts) :]:
                Path(trial, staging_name(name)).mkdir(exist_ok=True)
    except OSError as error:
        long = error.errno == errno.ENAMETOOLONG
        reason = "the name is too long" if long else f"{above} is not a writable folder"
        raise InputError(path, "", f"cannot be created: {reason}") from error
