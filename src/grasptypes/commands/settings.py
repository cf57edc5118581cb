"""What the commands share: the folder whose parameters and models they use."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path
from typing import Any

from grasptypes.errors import InputError
from grasptypes.params import load_params

SCHEMA = "workflow/schemas/params.schema.yaml"
PARAMS = "params.yaml"


def add_folder(parser: argparse.ArgumentParser) -> None:
    """The option that names the checkout."""
    parser.add_argument(
        "--folder",
        type=Path,
        default=Path(),
        help="checkout whose params.yaml and models are used (default: the current folder)",
    )


def folder_params(folder: Path) -> dict[str, Any]:
    """The checked parameters of a checkout.

    Raises:
        InputError: there are none, or they do not meet the schema.
    """
    if not (folder / PARAMS).is_file():
        raise InputError(folder / PARAMS, "", "no such file; name a checkout with --folder")
    return load_params(folder / PARAMS, folder / SCHEMA)


def check_target(path: Path, suffix: str) -> None:
    """Refuse a file that could not be written before anything is computed.

    Raises:
        InputError: another suffix, a folder, or a place where nothing can be written.
    """
    if path.suffix.lower() != suffix:
        raise InputError(path, "", f"must end in {suffix}")
    if path.is_dir():
        raise InputError(path, "", "is a folder")
    check_place(path)


def check_place(path: Path) -> None:
    """Refuse a file or folder that could not be made, by a try that leaves nothing behind.

    Raises:
        InputError: the nearest folder above it that is there cannot be written.
    """
    above = next(parent for parent in path.parents if parent.exists())
    try:
        with tempfile.TemporaryFile(dir=above):
            pass
    except OSError as error:
        message = f"cannot be made: {above} is no folder to write to"
        raise InputError(path, "", message) from error
