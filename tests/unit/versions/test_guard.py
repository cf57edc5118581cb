import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from grasptypes.errors import InputError
from grasptypes.versions.guard import (
    FolderLock,
    check_cache_links,
    remove_leftovers,
)

HOLDER = """
import sys, time
from grasptypes.versions.guard import FolderLock
lock = FolderLock(sys.argv[1])
assert lock.take()
print("held", flush=True)
time.sleep(60)
"""


def hold(state: Path) -> subprocess.Popen:
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[3] / "src")}
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(state)],
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "held\n"
    return process


def test_a_killed_run_leaves_no_lock(tmp_path: Path) -> None:
    process = hold(tmp_path)
    process.send_signal(signal.SIGKILL)
    process.wait()
    lock = FolderLock(tmp_path)
    assert lock.take()
    assert lock.take()
    assert lock.path.read_text() == str(os.getpid())


def test_a_living_run_keeps_its_lock_and_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    process = hold(tmp_path)
    lock = FolderLock(tmp_path, patience_s=0.2)
    try:
        assert not lock.take()
        message = f"another run holds this folder: process {process.pid}\n"
        assert capsys.readouterr().err == message
    finally:
        process.kill()
        process.wait()
    assert lock.take()


def test_what_a_killed_run_left_is_removed(tmp_path: Path) -> None:
    kept = tmp_path / "data" / "grasps.csv"
    lock = tmp_path / ".snakemake" / "locks" / "0.input.lock"
    half = tmp_path / "data" / "objects" / "mug" / ".surface.npz.4711.tmp"
    mine = tmp_path / "notes" / ".draft.tmp"
    folder = tmp_path / "reports" / ".mug_plan.4711.tmp"
    within = folder / "object" / ".mesh.4711.tmp"
    for path in (kept, lock, half, mine, within):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    assert set(remove_leftovers(tmp_path)) == {lock, half, folder, within}
    assert kept.exists()
    assert mine.exists()
    assert not lock.exists()
    assert not half.exists()
    assert not folder.exists()
    assert remove_leftovers(tmp_path) == []


def test_a_folder_that_takes_nothing_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=r"running\.lock: cannot be written: Not a directory"):
        FolderLock(tmp_path / "file" / "state").take()


@pytest.mark.parametrize(("call", "error"), [("fcntl.flock", "ENOLCK"), ("os.write", "ENOSPC")])
def test_a_disk_that_is_full_or_knows_no_locks_costs_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: str, error: str
) -> None:
    number = getattr(errno, error)

    def refuse(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(f"grasptypes.versions.guard.{call}", refuse)
    with pytest.raises(InputError, match=os.strerror(number)):
        FolderLock(tmp_path).take()


@pytest.mark.parametrize("types", ["hardlink", "symlink", '"reflink,hardlink,copy"'])
def test_a_cache_of_links_is_refused(tmp_path: Path, types: str) -> None:
    (tmp_path / ".dvc").mkdir()
    (tmp_path / ".dvc" / "config.local").write_text(f"[cache]\n    type = {types}\n")
    with pytest.raises(InputError, match=r"cache\.type"):
        check_cache_links(tmp_path)


def test_copies_and_reflinks_are_fine(tmp_path: Path) -> None:
    check_cache_links(tmp_path, {"HOME": "/nowhere", "XDG_CONFIG_HOME": "/nowhere"})
    check_cache_links(Path(__file__).parents[3])


def write_config(path: Path, types: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"[cache]\n    type = {types}\n    dir = /a%b\n")


@pytest.mark.parametrize("level", ["global", "system"])
def test_the_configurations_of_user_and_machine_count_if_the_checkout_says_nothing(
    tmp_path: Path, level: str
) -> None:
    from dvc.config import Config

    environment = {"XDG_CONFIG_HOME": f"{tmp_path}/user", "XDG_CONFIG_DIRS": f"{tmp_path}/machine"}
    with pytest.MonkeyPatch.context() as patch:
        for key, value in environment.items():
            patch.setenv(key, value)
        path = Path(Config.get_dir(level), "config")
    write_config(path, "hardlink")
    with pytest.raises(InputError, match=rf"{path}: cache\.type: 'hardlink'"):
        check_cache_links(tmp_path, environment)
    other = {**environment, f"DVC_{level.upper()}_CONFIG_DIR": str(tmp_path / "nowhere")}
    check_cache_links(tmp_path, other)
    write_config(tmp_path / ".dvc" / "config", "copy")
    check_cache_links(tmp_path, environment)


@pytest.mark.parametrize("content", [b"type = copy\n", b"[cache]\ntype\n", b"\xff\xfe"])
def test_a_configuration_that_cannot_be_read_is_named(tmp_path: Path, content: bytes) -> None:
    (tmp_path / ".dvc").mkdir()
    (tmp_path / ".dvc" / "config").write_bytes(content)
    with pytest.raises(InputError, match=r"config: is no configuration of DVC") as error:
        check_cache_links(tmp_path)
    assert "\n" not in str(error.value)
