"""Publishing that was cut off is known of, so that the next run can take it up again."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

# Beside Snakemake's own notes of what is unfinished. Each process has its own mark.
MARKS = Path(".snakemake/publishing")


@contextlib.contextmanager
def marked(root: Path) -> Iterator[None]:
    """Leave a mark for as long as the block runs, and for good if the process is killed in it."""
    mark = root / MARKS / str(os.getpid())
    mark.parent.mkdir(parents=True, exist_ok=True)
    mark.touch()
    try:
        yield
    finally:
        mark.unlink()


def take_up_publishing(root: Path) -> bool:
    """Publish again if a process was killed while it published; returns whether one was.

    Publishing adds nothing that is there, so it does no harm if one still lives.
    """
    marks = sorted((root / MARKS).glob("*"))
    if marks:
        command = [sys.executable, "-m", "grasptypes.runs.publishing"]
        if subprocess.run(command, cwd=root, check=False).returncode == 0:
            for mark in marks:
                mark.unlink(missing_ok=True)
    return bool(marks)
