"""Commands answer alike when Python drops docstrings and assertions (-OO)."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from grasptypes.commands.command_line import COMMANDS

HELP = "import sys; from grasptypes.commands import command_line; command_line.main(sys.argv[1:])"
CAMERA = "from grasptypes.renders.gl_platform import choose_platform; choose_platform()"


def python(*words: str, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = os.environ | variables
    command = [sys.executable, *words]
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False)


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_without_docstrings(command: str) -> None:
    text = " ".join(python("-OO", "-c", HELP, *command.split(), "--help").stdout.split())
    assert "None" not in text
    for name, module in COMMANDS.items():
        assert (module.SUMMARY in text) == (command in ("", name))


def test_commands_render_without_assertions(tmp_path: Path) -> None:
    words = ("hand", "check", "barrett", "--picture", str(tmp_path / "hand.png"))
    done = python("-m", "grasptypes", *words, PYTHONOPTIMIZE="2")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "hand.png").stat().st_size > 1000


def test_a_library_without_assertions_says_why_it_cannot_render() -> None:
    assert (
        "InputError: python -O: OpenGL needs Python's assertions"
        in python("-O", "-c", CAMERA).stderr
    )
