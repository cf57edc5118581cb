"""Remove what is left of objects, tasks and label sources that are no longer in the parameters.

Snakemake never deletes what it no longer makes, and DVC keeps the folders it versions: without
this, a removed object's files would travel with the data for ever.

``python -m grasptypes.versions.prune`` does it for the ``params.yaml`` of the current folder, but
not while Snakemake is at work there.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Collection
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.labels.label_sources import SOURCES
from grasptypes.objects.variants import all_objects
from grasptypes.settings.params import read_params
from grasptypes.versions.guard import FolderLock
from grasptypes.versions.job_records import RECORDS, recorded_result

OBJECT_FOLDERS = (
    "data/objects",
    "data/contact_maps",
    "data/grasps",
    "data/attempts",
    "data/renders",
    "data/features",
    "data/screenshots",
    "reports/figures/grasps",
    "data/generalisation/features",
)
TASK_FOLDERS = ("data/contact_maps", "data/grasps", "data/attempts")
PICTURE_FOLDERS = ("reports/figures/contact_maps",)
LABEL_FOLDERS = (
    "models",
    "reports/metrics",
    "reports/loss_curves",
    "reports/unseen",
    "reports/scores",
    "data/generalisation",
)
# The first that a file lies in says what it belongs to.
FOLDERS = (*OBJECT_FOLDERS, *PICTURE_FOLDERS, *LABEL_FOLDERS)

logger = logging.getLogger(__name__)


def prune(
    root: str | Path, objects: Collection[str], tasks: Collection[str], labels: Collection[str]
) -> list[Path]:
    """Delete the files, and Snakemake's records, of objects, tasks and labels that are not named.

    Returns:
        the deleted files, relative to ``root``, sorted.
    """
    root = Path(root)
    gone = [path for path in _files(root) if not _is_kept(path, objects, tasks, labels)]
    for path in gone:
        (root / path).unlink()
        _remove_empty_folders((root / path).parent, root)
    left = {str(path) for path in gone}
    for record in sorted((root / RECORDS).rglob("*")):
        if record.is_file() and recorded_result(record.relative_to(root / RECORDS)) in left:
            record.unlink()
            _remove_empty_folders(record.parent, root / RECORDS)
    return gone


def _files(root: Path) -> list[Path]:
    """Every file that may belong to one object or label source, relative to ``root``."""
    files = {path for name in FOLDERS for path in (root / name).rglob("*") if path.is_file()}
    return sorted(path.relative_to(root) for path in files)


def _is_kept(
    path: Path, objects: Collection[str], tasks: Collection[str], labels: Collection[str]
) -> bool:
    folder = next(folder for folder in FOLDERS if path.is_relative_to(folder))
    first, *rest = path.relative_to(folder).parts
    name = first.split(".")[0]
    if folder in LABEL_FOLDERS:
        return name in labels or name not in SOURCES
    if folder in PICTURE_FOLDERS:
        return name in {f"{object_}_{task}" for object_ in objects for task in tasks}
    if folder in TASK_FOLDERS and rest:
        return name in objects and rest[0].split(".")[0] in tasks
    return name in objects


def _remove_empty_folders(folder: Path, root: Path) -> None:
    while folder != root and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent


def main() -> None:
    """Prune the current folder and say what went."""
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    try:
        # Checked whole: a typing error must not pass for a removed object.
        params = read_params("params.yaml")
        lock = FolderLock()
        if not lock.take():  # and who holds it has been said
            sys.exit(1)
    except InputError as error:
        sys.exit(f"error: {error}")
    objects, tasks, labels = all_objects(params.objects), params.tasks, params.labels
    for path in prune(".", objects, tasks, labels):
        logger.info("removed %s, which is no longer in params.yaml", path)


if __name__ == "__main__":
    main()
