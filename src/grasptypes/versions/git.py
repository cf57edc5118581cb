"""What git says about a checkout."""

from __future__ import annotations

import subprocess
from pathlib import Path

from grasptypes.errors import InputError


def git(*arguments: str, folder: str | Path = ".") -> str:
    """The output of a git command.

    Raises:
        InputError: git is not installed, or refuses; with its own words, which often name a remedy.
    """
    try:
        run = subprocess.run(
            ["git", *arguments], cwd=folder, capture_output=True, text=True, check=False
        )
    except FileNotFoundError as error:
        if Path(folder).is_dir():
            raise InputError("git", "", "is not installed") from error
        raise InputError(folder, "", "no such folder") from error
    if run.returncode != 0:
        raise InputError(folder, "", f"git says: {run.stderr.strip()}")
    return run.stdout
