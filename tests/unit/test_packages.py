"""The packages stand on one another: none is imported by what it imports, even by a detour."""

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import grasptypes

SOURCE = Path(grasptypes.__file__).parent


def imported(code: str) -> set[str]:
    """Packages and top modules of the project that a module imports, inside functions too."""
    names = set()
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.ImportFrom) and node.module:
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
    return {name.split(".")[1] for name in names if name.startswith("grasptypes.")}


def test_no_package_imports_one_that_stands_on_it():
    uses: dict[str, set[str]] = {}
    for path in SOURCE.rglob("*.py"):
        package = path.relative_to(SOURCE).with_suffix("").parts[0]
        found = imported(path.read_text(encoding="utf-8"))
        uses[package] = uses.get(package, set()) | found - {package}
    order = list(TopologicalSorter(uses).static_order())
    assert order.index("objects") < order.index("labels") < order.index("predictors")
