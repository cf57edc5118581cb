"""What commands reject before they compute anything."""

import logging
import subprocess
import sys
from concurrent.futures.process import BrokenProcessPool
from importlib.metadata import version
from pathlib import Path

import pytest

from grasptypes.__main__ import main
from grasptypes.commands import label, predict
from grasptypes.commands.messages import say
from grasptypes.commands.settings import check_place, check_target
from grasptypes.errors import InputError


def test_targets_that_could_not_be_written_are_rejected(tmp_path):
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "file").touch()
    for target, reason in (
        (tmp_path / "picture.jpg", "must end in .png"),
        (tmp_path / "folder.png", "is a folder"),
        (tmp_path / "file" / "picture.png", "file is not a writable folder"),
        (Path("/proc/new/picture.png"), "/proc is not a writable folder"),
    ):
        with pytest.raises(InputError, match=reason):
            check_target(target, ".png")
    check_target(tmp_path / "new" / "picture.PNG", ".png")
    assert not (tmp_path / "new").exists()


def test_a_disk_that_fills_up_meanwhile_costs_one_line(monkeypatch):
    def run(_):
        Path("/dev/full").write_text("a picture")

    monkeypatch.setattr(predict, "run", run)
    with pytest.raises(SystemExit) as end:
        main(["predict", "cup.png"])
    assert str(end.value) == "error: No space left on device"


def test_a_reader_that_has_enough_is_no_error():
    code = (
        "from grasptypes.commands import command_line, predict; predict.run = lambda _: 'x' * 10**6"
    )
    code += "; command_line.main(['predict', 'cup.png'])"
    command = [sys.executable, "-c", code]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 141


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (MemoryError(), "error: not enough memory"),
        (BrokenProcessPool(), "error: not enough memory"),
        (KeyboardInterrupt(), "130"),
    ],
)
def test_a_command_that_is_cut_off_ends_without_a_trace(monkeypatch, error, status):
    def run(_):
        raise error

    monkeypatch.setattr(predict, "run", run)
    with pytest.raises(SystemExit) as end:
        main(["predict", "cup.png"])
    assert str(end.value.code).startswith(status)


def test_other_errors_of_a_command_are_not_swallowed(monkeypatch):
    def run(_):
        raise RuntimeError("a mistake of ours")

    monkeypatch.setattr(predict, "run", run)
    with pytest.raises(RuntimeError, match="ours"):
        main(["predict", "cup.png"])


def test_names_that_are_too_long_are_found_at_once(tmp_path):
    for name in ("x" * 250, "new/" + "x" * 300, "x" * 300 + "/new"):
        with pytest.raises(InputError, match="the name is too long"):
            check_place(tmp_path / name)
    check_place(tmp_path / "x" / "x" / "x")
    assert list(tmp_path.iterdir()) == []


def test_the_version_is_that_of_the_package(capsys):
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert end.value.code == 0
    assert capsys.readouterr().out == f"grasptypes {version('grasptypes')}\n"


def test_a_shell_completes_commands_and_options(capsys):
    with pytest.raises(SystemExit, match="0"):
        main(["--print-completion", "bash"])
    script = capsys.readouterr().out
    for words, completed in (("pl", "plan"), ("plan --ta", "--task"), ("plan --unit in", "inch")):
        typed = ["grasptypes", *words.split()]
        ask = f"COMP_WORDS=({' '.join(typed)}); COMP_CWORD={len(typed) - 1}; _shtab_grasptypes"
        code = f'{script}\n{ask}; echo "${{COMPREPLY[@]}}"'
        done = subprocess.run(["bash", "-c", code], capture_output=True, text=True, check=False)
        assert done.stdout.strip() == completed, done.stderr


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], ["searching", "warning: mended"]),
        (["-q"], []),
        (["-v"], ["searching", "warning: mended", "info: egl"]),
    ],
    ids=["default", "quiet", "verbose"],
)
def test_how_much_is_said_on_standard_error(options, said, monkeypatch, capfd):
    def run(_):
        say("searching")
        logging.getLogger("grasptypes.objects").warning("mended")
        logging.getLogger("grasptypes.renders").info("egl")
        return "answer\n"

    monkeypatch.setattr(label, "run", run)
    monkeypatch.setattr(logging.getLogger(), "handlers", [])
    main(["label", "grasps.csv", "--object", "mug.stl", *options])
    printed = capfd.readouterr()
    assert (printed.out, printed.err.splitlines()) == ("answer\n", said)
