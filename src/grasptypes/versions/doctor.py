"""Find what would make results untrustworthy, and say which command mends it.

``python -m grasptypes.versions.doctor`` examines the current folder; exit status 1 if anything is
wrong.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.errors import InputError
from grasptypes.versions.guard import check_cache_links


def edited_files(status: Mapping[str, Any], data_status: Mapping[str, Any]) -> list[str]:
    """Results that changed although nothing they are made from did.

    Args:
        status: what ``dvc status --json`` prints: changes by stage.
        data_status: what ``dvc data status --granular --json`` prints: changes by file.

    Returns:
        paths, sorted; within a versioned folder the files themselves.
    """
    edited: set[str] = set()
    for changes in status.values():
        merged: dict[str, Any] = {}
        for change in changes:
            merged.update(change if isinstance(change, dict) else {change: True})
        if set(merged) == {"changed outs"}:
            edited |= {path for path, kind in merged["changed outs"].items() if kind == "modified"}
    files = data_status.get("uncommitted", {}).get("modified", [])
    found = set()
    for path in edited:
        within = {file for file in files if file.startswith(path.rstrip("/") + "/")}
        found |= within or {path}
    return sorted(found)


def diagnose(root: Path) -> list[str]:
    """One line a problem, each with the command that mends it."""
    problems = []
    try:
        check_cache_links(root)
    except InputError as error:
        problems.append(str(error))
    status = _dvc(root, "status", "--json")
    for path in edited_files(status, _dvc(root, "data", "status", "--granular", "--json")):
        tracked = subprocess.run(["git", "ls-files", "--error-unmatch", path], cwd=root,
                                 capture_output=True, check=False).returncode == 0  # fmt: skip
        mend = f"git checkout -- {path}" if tracked else f"dvc checkout --force {path}"
        problems.append(f"{path}: changed by hand since it was computed; mend it with: {mend}")
    return problems


def _dvc(root: Path, *arguments: str) -> dict[str, Any]:
    command = [sys.executable, "-m", "dvc", *arguments]
    result = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise InputError("dvc.yaml", "", result.stderr.strip() or "dvc cannot read it")
    return json.loads(result.stdout or "{}")


def main() -> None:
    """Print the problems, or that there are none."""
    try:
        problems = diagnose(Path.cwd())
    except InputError as error:
        problems = [str(error)]
    sys.stdout.write("\n".join(problems or ["nothing is wrong"]) + "\n")
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
