"""Scripts are modules: they can be imported, and say what they do."""

import ast
import importlib.util
import inspect
from pathlib import Path
from types import ModuleType

import pytest
from repository import ROOT

SCRIPTS = sorted((ROOT / "workflow" / "scripts").glob("*.py"))


def load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_a_script_can_be_imported_and_says_what_it_does(path: Path) -> None:
    module = load(path)
    assert module.__doc__
    for function in filter(inspect.isfunction, vars(module).values()):
        if function.__module__ != path.stem:
            continue
        assert function.__name__.startswith("_") or function.__doc__, function.__name__
        assert function.__annotations__.get("return", ...) is not ..., function.__name__


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_snakemake_is_known_under_main_only(path: Path) -> None:
    tree = ast.parse(path.read_text())
    for statement in tree.body:
        main = isinstance(statement, ast.If) and "__main__" in ast.unparse(statement.test)
        names = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
        assert main or "snakemake" not in names, ast.unparse(statement)[:80]
