"""Content hashes of files and code.

They are rule parameters and keys of Numba's cache, so that staleness never depends on file times.
"""

from __future__ import annotations

import ast
import contextlib
import functools
import hashlib
import json
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from grasptypes.files import file_sha256, write_text

_SOURCE = Path(__file__).resolve().parents[1]
_PACKAGE = Path(__file__).resolve().parent.name
# Caches written by another version of this module or of Python's syntax trees may differ.
_VERSION = f"{hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:16]} {sys.version_info[:2]}"


class FileMemory:
    """A function of a file, cached by inode, size and times.

    Args:
        function: takes a path and returns something JSON can store.
        memory: JSON file that keeps the results between processes and is safe to delete; None
            keeps them for this process only.
    """

    def __init__(self, function: Callable[[Path], Any], memory: str | Path | None = None) -> None:
        self.function = function
        self.memory = Path(memory) if memory is not None else None
        self.known: dict[str, list[Any]] = {}
        if self.memory is not None:
            with contextlib.suppress(OSError, ValueError):  # missing or damaged: start over
                self.known = json.loads(self.memory.read_text())

    def __call__(self, path: str | Path) -> Any:
        """The function's result for the current content of a file.

        Raises:
            FileNotFoundError: the file does not exist.
        """
        status = os.stat(path)
        stamp = [status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns, _VERSION]
        known = self.known.get(str(path))
        if known is None or known[0] != stamp:
            known = self.known[str(path)] = [stamp, self.function(Path(path))]
            if self.memory is not None:
                write_text(self.memory, json.dumps(self.known))
        return known[1]


class FileHash:
    """SHA-256 of files; see :class:`FileMemory`."""

    def __init__(self, memory: str | Path | None = None) -> None:
        self.read = FileMemory(lambda path: file_sha256(path)[:16], memory)

    def __call__(self, path: str | Path) -> str:
        """The first 16 hex digits of the file's SHA-256, or ``"missing"``."""
        try:
            return str(self.read(path))
        except FileNotFoundError:
            return "missing"


class CodeHash:
    """Hash of Python files and of every module of this package they import, directly or not.

    Syntax trees are hashed without docstrings, so comments, docstrings and layout do not matter,
    but every statement in an imported module does. See :class:`FileMemory`.
    """

    def __init__(self, memory: str | Path | None = None) -> None:
        self.read = FileMemory(_read, memory)

    def __call__(self, *scripts: str | Path) -> str:
        """The first 16 hex digits of a hash of the files' statements and of all they import."""
        digest = hashlib.sha256()
        for name, path in sorted((_name(path), path) for path in self.files(*scripts)):
            digest.update(f"{name} {self.read(path)[0]}\n".encode())
        return digest.hexdigest()[:16]

    def files(self, *scripts: str | Path) -> set[Path]:
        """The Python files and all modules of this package they import, directly or not."""
        todo = {Path(script).resolve() for script in scripts}
        seen: set[Path] = set()
        while todo:
            path = todo.pop()
            seen.add(path)
            found = {_module_file(module) for module in self.read(path)[1]}
            todo |= {file for file in found if file is not None} - seen
        return seen


def _read(path: Path) -> tuple[str, list[str]]:
    """A digest of a file's statements, and names of this package that it may import."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    modules: set[str] = set()
    for node in _running(tree):  # the package uses absolute imports only
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            modules |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
        body = getattr(node, "body", None)
        if isinstance(body, list) and body and _is_docstring(body[0]):
            body[0].value.value = ""
    names = sorted({name for module in modules for name in _with_packages(module)})
    return hashlib.sha256(ast.dump(tree).encode()).hexdigest(), names


def _running(tree: ast.AST) -> Iterator[ast.AST]:
    """The nodes of a tree, without what is for type checkers only."""
    yield tree
    for child in ast.iter_child_nodes(tree):
        test = getattr(child, "test", None)
        if not (isinstance(child, ast.If) and getattr(test, "id", "") == "TYPE_CHECKING"):
            yield from _running(child)


def _is_docstring(node: ast.AST) -> bool:
    return (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
    )


def _name(path: Path) -> str:
    """Name of the file that is the same in every checkout."""
    return str(path.relative_to(_SOURCE)) if path.is_relative_to(_SOURCE) else path.name


def _with_packages(module: str) -> list[str]:
    """The module and its parent packages, which its import runs; empty for other packages."""
    parts = module.split(".")
    depths = range(1, len(parts) + 1) if parts[0] == _PACKAGE else ()
    return [".".join(parts[:depth]) for depth in depths]


@functools.cache
def _module_file(module: str) -> Path | None:
    path = _SOURCE.joinpath(*module.split("."))
    for candidate in (path.with_suffix(".py"), path / "__init__.py"):
        if candidate.is_file():
            return candidate
    return None
