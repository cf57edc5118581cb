"""Machine code on disk answers only for the sources it was made from."""

import ast
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import grasptypes

PACKAGE = Path(grasptypes.__file__).parent
MODULES = {
    "caller.py": """
from grasptypes.callee import twice
from grasptypes.compiled import compiled

@compiled()
def answer(number):
    return twice(number) + 1
""",
    "callee.py": """
from grasptypes.compiled import compiled
from grasptypes.constants import FACTOR

@compiled(inline=True)
def twice(number):
    return FACTOR * number
""",
    "constants.py": "FACTOR = 2\n",
}


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A copy of what compiles, with a function whose callee and constant lie in other modules."""
    folder = tmp_path / "src" / "grasptypes"
    folder.mkdir(parents=True)
    for name in ("__init__", "compiled", "content_hash", "errors", "files"):
        shutil.copy(PACKAGE / f"{name}.py", folder)
    for name, text in MODULES.items():
        (folder / name).write_text(text)
    return folder


def answer(package: Path, **variables: str) -> tuple[int, int]:
    """`answer(10)` in a process of its own, and how many functions it took from the cache."""
    code = """
from grasptypes.caller import answer
print(answer(10), sum(answer.stats.cache_hits.values()))
"""
    environment = {**os.environ, "PYTHONPATH": str(package.parent), **variables}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    first, second = done.stdout.split()
    return int(first), int(second)


@pytest.mark.parametrize("folder", ["", "cache"])
def test_edits_of_a_callee_and_of_a_constant_elsewhere_change_the_answer(package, folder, tmp_path):
    variables = {"NUMBA_CACHE_DIR": str(tmp_path / folder)} if folder else {}
    assert answer(package, **variables) == (21, 0)
    assert answer(package, **variables) == (21, 1)
    (package / "constants.py").write_text("FACTOR = 3\n")
    assert answer(package, **variables) == (31, 0)
    callee = package / "callee.py"
    callee.write_text(callee.read_text().replace("* number", "* number * 10"))
    assert answer(package, **variables) == (301, 0)
    assert answer(package, **variables) == (301, 1)


def test_a_comment_elsewhere_keeps_the_machine_code(package):
    assert answer(package) == (21, 0)
    (package / "constants.py").write_text("# How many times.\nFACTOR = 2\n")
    assert answer(package) == (21, 1)


def test_every_compiled_function_of_the_package_is_kept_this_way():
    for path in set(PACKAGE.rglob("*.py")) - {PACKAGE / "compiled.py"}:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [alias.name for alias in getattr(node, "names", ())]
            modules = [*names, str(getattr(node, "module", ""))]
            assert not any(module.split(".")[0] == "numba" for module in modules), path
