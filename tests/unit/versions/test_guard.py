"""One run at a time, nothing half-written, no cache of links."""

import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from grasptypes.errors import InputError
from grasptypes.versions.guard import FolderLock, check_cache_links, remove_leftovers

HOLDER = """
import sys, time
from grasptypes.versions.guard import FolderLock
lock = FolderLock(sys.argv[1])
assert lock.take()
print("held", flush=True)
time.sleep(60)
"""


def test_a_living_run_is_named_and_a_killed_one_leaves_no_lock(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(tmp_path)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "held\n"
    lock = FolderLock(tmp_path, patience_s=0.2)
    try:
        assert not lock.take()
        message = f"another run is active in this folder: process {process.pid}\n"
        assert capsys.readouterr().err == message
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert lock.take()
    assert lock.take()
    assert lock.path.read_text() == str(os.getpid())


@pytest.mark.parametrize("error", ["ENOLCK", "ENOSPC"])
def test_a_disk_that_is_full_or_knows_no_locks_is_an_error_of_the_system(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: str
) -> None:
    def refuse(*_: object) -> None:
        raise OSError(getattr(errno, error), "refused")

    call = "fcntl.flock" if error == "ENOLCK" else "grasptypes.versions.guard.write_bytes"
    monkeypatch.setattr(call, refuse)
    with pytest.raises(OSError, match="refused"):
        FolderLock(tmp_path).take()


def test_what_a_killed_run_left_is_removed(tmp_path: Path) -> None:
    kept = [tmp_path / "data/grasps.csv", tmp_path / "notes/.draft.tmp"]
    left = [
        tmp_path / "data/objects/mug/.surface.npz.4711.tmp",
        tmp_path / "reports/.mug_plan.4711.tmp/object/.mesh.4711.tmp",
    ]
    for path in kept + left:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    remove_leftovers(tmp_path)
    assert all(path.exists() for path in kept)
    assert not any(path.exists() for path in left)
    assert not (tmp_path / "reports/.mug_plan.4711.tmp").exists()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ('[cache]\n    type = "reflink,hardlink"\n    dir = /a%b\n', "'reflink,hardlink' would"),
        ("type = copy\n", "is not a valid DVC configuration"),
    ],
)
def test_a_cache_of_links_is_refused(tmp_path: Path, content: str, message: str) -> None:
    (tmp_path / ".dvc").mkdir()
    (tmp_path / ".dvc/config.local").write_text(content)
    with pytest.raises(InputError, match=message):
        check_cache_links(tmp_path)
    check_cache_links(Path(__file__).parents[3])
