"""A note that results are still to be shown in MLflow: it outlives a run that is killed.

Snakemake calls nobody when there is no job to do, so the next run would not publish by itself.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

# Beside Snakemake's own notes of what is unfinished.
NOTE = Path(".snakemake/publishing_due")


def publishing_is_due(root: Path) -> bool:
    """Whether a run began since everything was published, and a model is there to publish."""
    return (root / NOTE).exists() and any((root / "models").glob("*/*/predictor.json"))


def note_due(root: Path) -> None:
    """Note that a run begins."""
    (root / NOTE).parent.mkdir(parents=True, exist_ok=True)
    (root / NOTE).touch()


def note_done(root: Path) -> None:
    """Note that everything is published."""
    (root / NOTE).unlink(missing_ok=True)


def publish_what_is_due(root: Path) -> None:
    """Publish in a process of its own, which says what is wrong if it cannot."""
    if publishing_is_due(root):
        subprocess.run([sys.executable, "-m", "grasptypes.runs.publishing"], cwd=root, check=False)
