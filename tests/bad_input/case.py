"""A mistake that a user can make, and how it is reported."""

from __future__ import annotations

import contextlib
import importlib.util
import io
import os
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from grasptypes.errors import InputError
from grasptypes.jobs import job
from grasptypes.settings.params import read_params
from grasptypes.start_up import check_start
from grasptypes.yaml_files import read_yaml

ROOT = Path(__file__).parents[2]
PARAMS = read_yaml(ROOT / "params.yaml")

Content = bytes | str | Callable[[Path], object]


@dataclass(frozen=True)
class Case:
    """A mistake.

    Attributes:
        kind: kind of input; the sections of the table.
        what: the mistake.
        files: path to content, or to a function that writes it.
        call: what the user runs, in the folder of the files.
        names: texts that the message must contain: the file, the key, and what is allowed.
        environment: environment variables set by the user.
    """

    kind: str
    what: str
    files: Mapping[str, Content]
    call: Callable[[], object]
    names: tuple[str, ...]
    environment: Mapping[str, str] = field(default_factory=dict)

    def write_files(self) -> None:
        """Put the files into the current folder."""
        for name, content in self.files.items():
            path = Path(name)
            path.parent.mkdir(parents=True, exist_ok=True)
            if callable(content):
                content(path)
            else:
                path.write_bytes(content.encode() if isinstance(content, str) else content)


@dataclass(frozen=True)
class Outcome:
    """How a call ended: exit status, everything it printed, and the files it changed or wrote."""

    status: int
    printed: str
    written: list[str]


def try_in(folder: Path, case: Case) -> Outcome:
    """Put the files of a case into a new folder and start what the user starts there."""
    folder.mkdir()
    before = dict(os.environ)
    with contextlib.chdir(folder):
        case.write_files()
        there = _content()
        os.environ |= case.environment
        try:
            status, printed = _end_of(case)
        finally:
            os.environ.clear()
            os.environ.update(before)
        return Outcome(status, printed, sorted(set(_content() ^ there)))


def _content() -> set[str]:
    """Every path below the current folder, with the time and size of what it holds."""
    paths = [(path, path.stat()) for path in Path().rglob("*")]
    return {f"{path} {stat.st_mtime_ns} {stat.st_size}" for path, stat in paths}


def _end_of(case: Case) -> tuple[int, str]:
    """Exit status and output; unexpected exceptions are raised."""
    printed = io.StringIO()
    status = 0
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        try:
            case.call()
        except SystemExit as end:
            status = 1 if isinstance(end.code, str) else int(end.code or 0)
            printed.write(f"{end.code}\n" if isinstance(end.code, str) else "")
    return status, printed.getvalue()


def start() -> None:
    """What the Snakefile does before anything else."""
    try:
        check_start(read_params("params.yaml"), ".", os.environ)
    except InputError as error:
        sys.exit(f"error: {error}")


def script(name: str, function: str, *arguments: Any) -> Callable[[], None]:
    """A job of the workflow: a function of its script, with a log beside the folder."""

    def call() -> None:
        with job(["../job.log"]):
            getattr(_module(name), function)(*arguments)

    return call


def library(function: Callable[..., object], *arguments: Any) -> Callable[[], None]:
    """A function of the library, its error shown as the commands show it."""

    def call() -> None:
        try:
            function(*arguments)
        except InputError as error:
            sys.exit(f"error: {error}")

    return call


def _module(name: str) -> Any:
    path = ROOT / "workflow/scripts" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
