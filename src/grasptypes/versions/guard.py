"""Start-up checks: a run uses this checkout's code and is not blocked by a dead one's lock."""

from __future__ import annotations

import configparser
import fcntl
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import IO

from grasptypes.errors import InputError
from grasptypes.files import TEMPORARY

# What a run writes before its first job.
ROOM_BYTES = 2**17


class FolderLock:
    """That one process at a time computes in a folder.

    Snakemake's own lock does not know whether its owner is alive. The kernel releases this one
    however the process ends: whoever has it knows that nobody else is running.

    Args:
        state: Snakemake's folder for what it notes.
        patience_s: how long another process may hold the lock, such as a dry run that is short.
    """

    def __init__(self, state: str | Path = ".snakemake", patience_s: float = 2.0) -> None:
        self.path = Path(state) / "running.lock"
        self.patience_s = patience_s
        self.file: IO | None = None

    def take(self) -> bool:
        """Hold the lock until the process ends, or say who holds it; returns whether we do.

        Raises:
            InputError: the folder cannot be written, is full, or its file system knows no locks.
        """
        if self.file is None:
            try:
                self.path.parent.mkdir(exist_ok=True)
                with tempfile.TemporaryFile(dir=self.path.parent) as trial:
                    trial.write(bytes(ROOM_BYTES))
                self.file = self._locked()
            except OSError as error:
                raise InputError(self.path, "", f"cannot be written: {error.strerror}") from error
        return self.file is not None

    def _locked(self) -> IO | None:
        deadline = time.monotonic() + self.patience_s
        file = open(self.path, "a+")  # noqa: SIM115 - open until the process ends
        while True:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() > deadline:
                    with file:
                        file.seek(0)
                        owner = file.read().strip() or "an unknown process"
                    sys.stderr.write(f"another run holds this folder: process {owner}\n")
                    return None
                time.sleep(0.1)
        os.truncate(file.fileno(), 0)
        os.write(file.fileno(), str(os.getpid()).encode())
        return file


def remove_leftovers(root: str | Path) -> list[Path]:
    """Remove what a killed run left: Snakemake's lock, and files half written.

    Only for who holds the folder's lock. Results are written under another name and renamed, so
    nobody ever reads a file that is half written.

    Returns:
        the removed files and folders.

    Raises:
        InputError: one cannot be removed.
    """
    locks = (Path(root) / ".snakemake/locks").glob("*.lock")
    folders = (Path(root) / name for name in ("data", "models", "reports"))
    halves = (path for folder in folders for path in folder.rglob(f".*{TEMPORARY}"))
    found = [*locks, *halves]
    for path in found:
        try:
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink(missing_ok=True)  # it lay in a folder that is gone
        except OSError as error:
            message = f"half written, and cannot be removed: {error.strerror}"
            raise InputError(path, "", message) from error
    return found


def check_cache_links(root: str | Path, environment: Mapping[str, str] = os.environ) -> None:
    """Refuse a DVC cache of hard or symbolic links.

    Through a link, a rerun writes into the cache itself: earlier versions are corrupted and stale
    results pass for current ones.

    Raises:
        InputError: naming DVC's configuration file and the setting.
    """
    types, source = "", Path()
    for path in dvc_configs(Path(root), environment):
        settings = configparser.ConfigParser(strict=False, interpolation=None)
        try:
            settings.read(path, encoding="utf-8")
        except (configparser.Error, UnicodeDecodeError) as error:
            raise InputError(path, "", f"is no configuration of DVC: {error}") from error
        if settings.has_option("cache", "type"):
            types, source = settings.get("cache", "type").strip("\"'"), path
    if "link" in types.replace("reflink", ""):
        message = (
            f"'{types}' would corrupt earlier versions; use: dvc config cache.type reflink,copy"
        )
        raise InputError(source, "cache.type", message)


def dvc_configs(root: Path, environment: Mapping[str, str]) -> list[Path]:
    """The configuration files of DVC, the one that counts most last; some may not be there.

    Paths as in `dvc.dirs`, which takes a tenth of a second to import.
    """
    user = environment.get("XDG_CONFIG_HOME") or Path.home() / ".config"
    machine = environment.get("XDG_CONFIG_DIRS", "").split(os.pathsep)[0] or "/etc/xdg"
    return [
        Path(environment.get("DVC_SYSTEM_CONFIG_DIR") or Path(machine, "dvc"), "config"),
        Path(environment.get("DVC_GLOBAL_CONFIG_DIR") or Path(user, "dvc"), "config"),
        root / ".dvc" / "config",
        root / ".dvc" / "config.local",
    ]
