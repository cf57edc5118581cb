"""Content hashes that stand as rule parameters, so that staleness never depends on file times."""

from __future__ import annotations

import ast
import functools
import hashlib
import json
import os
from pathlib import Path

from grasptypes.files import write_text

_SOURCE = Path(__file__).resolve().parents[2]
_PACKAGE = Path(__file__).resolve().parents[1].name


def code_hash(*scripts: str | Path) -> str:
    """Hash of Python files and of every module of this package they import, directly or not.

    The syntax trees are hashed without their docstrings: comments, docstrings and layout change
    nothing; a changed statement anywhere below does.
    """
    digest = hashlib.sha256()
    for name, path in sorted((_name(path), path) for path in code_files(*scripts)):
        digest.update(f"{name} {_read(path)[0]}\n".encode())
    return digest.hexdigest()[:16]


def code_files(*scripts: str | Path) -> set[Path]:
    """The Python files and all of this package that they import, directly or not."""
    todo = {Path(script).resolve() for script in scripts}
    seen: set[Path] = set()
    while todo:
        path = todo.pop()
        seen.add(path)
        todo |= _read(path)[1] - seen
    return seen


@functools.cache
def _read(path: Path) -> tuple[str, set[Path]]:
    """A digest of the file's statements, and the files of this package that it imports."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    modules: set[str] = set()
    for node in ast.walk(tree):  # the package uses absolute imports only
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            modules |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
        body = getattr(node, "body", None)
        if isinstance(body, list) and body and _is_docstring(body[0]):
            body[0].value.value = ""
    files = {_module_file(name) for module in modules for name in _with_packages(module)}
    return hashlib.sha256(ast.dump(tree).encode()).hexdigest(), {
        file for file in files if file is not None
    }


def _is_docstring(node: ast.AST) -> bool:
    return (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
    )


def _name(path: Path) -> str:
    """A name for the file that is the same in every checkout."""
    return str(path.relative_to(_SOURCE)) if path.is_relative_to(_SOURCE) else path.name


def _with_packages(module: str) -> list[str]:
    """The module and the packages it lies in, which its import runs; nothing of other packages."""
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


class FileHash:
    """SHA-256 of files, remembered by inode, size and times so that unchanged ones are not reread.

    Args:
        memory: a JSON file that keeps the hashes between calls; safe to delete.
    """

    def __init__(self, memory: str | Path) -> None:
        self.memory = Path(memory)
        try:
            self.known: dict[str, list] = json.loads(self.memory.read_text())
        except (OSError, ValueError):
            self.known = {}

    def __call__(self, path: str | Path) -> str:
        """The first 16 hex digits of the file's SHA-256, or ``"missing"``."""
        try:
            status = os.stat(path)
        except FileNotFoundError:
            return "missing"
        stamp = [status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns]
        known = self.known.get(str(path))
        if known is not None and known[0] == stamp:
            return str(known[1])
        with open(path, "rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()[:16]
        self.known[str(path)] = [stamp, digest]
        write_text(self.memory, json.dumps(self.known))
        return digest
