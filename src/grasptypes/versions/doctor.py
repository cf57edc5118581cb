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
from grasptypes.versions.job_records import RECORDS, record_path

# Longer than any file system's clock ticks.
TICK_S = 0.01


def changed_files(status: Mapping[str, Any], data_status: Mapping[str, Any]) -> list[str]:
    """Results that are not what dvc.lock names although nothing they are made from changed.

    Args:
        status: what ``dvc status --json`` prints: changes by stage.
        data_status: what ``dvc data status --granular --json`` prints: changes by file.

    Returns:
        paths, sorted; within a versioned folder the files themselves.
    """
    changed: set[str] = set()
    for changes in status.values():
        merged: dict[str, Any] = {}
        for change in changes:
            merged.update(change if isinstance(change, dict) else {change: True})
        if set(merged) == {"changed outs"}:
            changed |= {path for path, kind in merged["changed outs"].items() if kind == "modified"}
    modified = data_status.get("uncommitted", {}).get("modified", [])
    files = [file for file in modified if not file.endswith("/")]
    found = set()
    for path in changed:
        within = {file for file in files if file.startswith(path.rstrip("/") + "/")}
        found |= within or {path}
    return sorted(found)


def is_edited(path: str, root: Path) -> bool:
    """Whether a result was written after the job that made it, as Snakemake's record tells."""
    if path.startswith(RECORDS):
        return False
    record = root / record_path(path)
    if not record.is_file():
        return True
    made = json.loads(record.read_text(encoding="utf-8"))["endtime"]
    return bool((root / path).stat().st_mtime > made + TICK_S)


def diagnose(root: Path) -> list[str]:
    """One line a problem, each with the command that mends it."""
    problems = []
    try:
        check_cache_links(root)
    except InputError as error:
        problems.append(str(error))
    status = _dvc(root, "status", "--json")
    changed = changed_files(status, _dvc(root, "data", "status", "--granular", "--json"))
    edited = [path for path in changed if is_edited(path, root)]
    problems += [
        f"{path}: changed by hand since it was computed; mend it with: {_mend(root, path)}"
        for path in edited
    ]
    if len(edited) < len(changed):
        problems.append(
            "dvc.lock: does not know what was computed since; record it with: dvc repro"
        )
    return problems


def _mend(root: Path, path: str) -> str:
    if not _git(root, "ls-files", "--error-unmatch", path):
        return f"dvc checkout --force {path}"
    if _git(root, "diff", "--quiet", "HEAD", "--", "dvc.lock"):
        return f"git checkout -- {path}"
    # What git has belongs to another dvc.lock.
    return f"rm {path} && snakemake -j2 {path}"


def _git(root: Path, *arguments: str) -> bool:
    command = ["git", "-C", str(root), *arguments]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


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
