"""The tools' own command lines, in processes that find the tools' packages imported.

Hundreds of questions become affordable so; each call has a process of its own and does what it does
in a shell. Nothing of this project is imported beforehand: the folder's own code answers.
"""

from __future__ import annotations

import multiprocessing
import os
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

CONTEXT = multiprocessing.get_context("forkserver")
CONTEXT.set_forkserver_preload(
    ["snakemake.cli", "snakemake.report", "dvc.cli", "dvc.commands.status", "dvc.repo.status"]
    + ["jsonschema", "numpy", "pandas", "pandera.pandas", "scipy.spatial", "torch", "trimesh"]
)


def ask(folder: Path, environment: Mapping[str, str], tool: str, *arguments: str) -> str:
    """What a command prints, on either channel."""
    with tempfile.NamedTemporaryFile("r") as output:
        process = CONTEXT.Process(
            target=_answer, args=(str(folder), dict(environment), output.name, tool, arguments)
        )
        process.start()
        process.join()
        return Path(output.name).read_text()


def modules_of(folder: Path, environment: Mapping[str, str], script: str) -> set[str]:
    """The modules of this project that Python itself imports to load a script, as paths."""
    lines = ask(folder, environment, "imports", script).splitlines()
    return {line for line in lines if line.startswith("src/")}


def _answer(
    folder: str, environment: dict[str, str], output: str, tool: str, arguments: tuple[str, ...]
) -> None:
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    channel = os.open(output, os.O_WRONLY)
    os.dup2(channel, 1)
    os.dup2(channel, 2)
    sys.argv = [tool, *arguments]
    if tool == "snakemake":
        from snakemake.cli import main

        main(list(arguments))
    elif tool == "dvc":
        from dvc.cli import main

        sys.exit(main(list(arguments)))
    else:
        _print_imports(folder, arguments[0])


def _print_imports(folder: str, script: str) -> None:
    import runpy

    sys.path.insert(0, str(Path(folder) / "src"))
    runpy.run_path(script, run_name="loaded")
    for name, module in list(sys.modules.items()):
        if name.split(".")[0] == "grasptypes":
            os.write(1, f"{Path(module.__file__).relative_to(folder)}\n".encode())
