"""Start-up checks: one run per folder, no half-written files, and no DVC cache of links."""

from __future__ import annotations

import configparser
import os
import shutil
import sys
from pathlib import Path

from filelock import FileLock, Timeout

from grasptypes.errors import InputError, parsing
from grasptypes.files import TEMPORARY, write_bytes

# What a run writes before its first job.
ROOM_BYTES = 2**20


class FolderLock:
    """Ensures that only one process at a time computes in a folder.

    The kernel releases the lock however the process ends, so the holder knows that nobody else is
    running. Snakemake's own lock survives a kill and is switched off (profiles/default).

    Args:
        state: Snakemake's folder for its records.
        patience_s: how long to wait for another process, such as a short dry run.
    """

    def __init__(self, state: str | Path = ".snakemake", patience_s: float = 2.0) -> None:
        self.path = Path(state) / "running.lock"
        self._lock = FileLock(
            self.path, timeout=patience_s, thread_local=False, fallback_to_soft=False
        )

    def take(self) -> bool:
        """Acquire the lock until the process ends; if that fails, print the holder and return
        False.

        Raises:
            OSError: the folder is not writable, the disk is full, or the file system has no locks.
        """
        self.path.parent.mkdir(exist_ok=True)
        try:
            self._lock.acquire()
        except Timeout:
            owner = self.path.read_text() or "unknown"
            sys.stderr.write(f"another run is active in this folder: process {owner}\n")
            return False
        room = self.path.with_name("room.test")
        write_bytes(room, bytes(ROOM_BYTES))
        room.unlink()
        self.path.write_text(str(os.getpid()))
        return True


def remove_leftovers(root: str | Path) -> None:
    """Remove half-written files of a killed run; the caller must hold the folder's lock.

    Results are written under a temporary name and renamed, so a partial result is never read.
    """
    folders = (Path(root) / name for name in ("data", "models", "reports"))
    for path in [path for folder in folders for path in folder.rglob(f".*{TEMPORARY}")]:
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)  # its folder may be gone


def check_cache_links(root: str | Path) -> None:
    """Reject a DVC cache of hard or symbolic links.

    Through a link, a rerun writes into the cache itself: earlier versions are corrupted, and stale
    results look current. The checkout's configuration takes precedence over the user's.

    Raises:
        InputError: names DVC's configuration file and the setting.
    """
    for path in (Path(root) / ".dvc" / name for name in ("config", "config.local")):
        settings = configparser.ConfigParser(strict=False, interpolation=None)
        with parsing(path, "is not a valid DVC configuration"):
            settings.read(path, encoding="utf-8")
        types = settings.get("cache", "type", fallback="").strip("\"'")
        if "link" in types.replace("reflink", ""):
            message = f"'{types}' would corrupt earlier versions; use 'reflink,copy'"
            raise InputError(path, "cache.type", message)
