"""Commands answer alike when Python drops docstrings and assertions (-OO)."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

from grasptypes.commands.command_line import COMMANDS

HELP = """
import contextlib, io, json, sys
from grasptypes.commands import command_line
texts = {}
for command in json.loads(sys.argv[1]):
    with contextlib.redirect_stdout(io.StringIO()) as text, contextlib.suppress(SystemExit):
        command_line.main([*command.split(), "--help"])
    texts[command] = text.getvalue()
print(json.dumps(texts))
"""
CAMERA = "from grasptypes.renders.gl_platform import choose_platform; choose_platform()"


def python(*words: str, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = os.environ | variables
    command = [sys.executable, *words]
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False)


def test_help_without_docstrings() -> None:
    texts = json.loads(python("-OO", "-c", HELP, json.dumps(["", *COMMANDS])).stdout)
    for command, lines in texts.items():
        text = " ".join(lines.split())
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
