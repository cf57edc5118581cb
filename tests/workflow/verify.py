"""Compute everything twice from nothing, with one job and with two at a time, and compare.

``python tests/workflow/verify.py FOLDER [CHANGES.yaml]``, the changes being laid over params.yaml,
prints every file's checksum and whether both runs made it; the exit status is 1 if any differs.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

from grasptypes.versions.checkout import copy_checkout

ROOT = Path(__file__).parents[2]
RESULTS = ("data", "models", "reports")


def checksums(root: Path) -> dict[str, str]:
    """Every file of the results and its SHA-256."""
    paths = sorted(path for name in RESULTS for path in (root / name).rglob("*") if path.is_file())
    return {
        str(path.relative_to(root)): hashlib.sha256(path.read_bytes()).hexdigest() for path in paths
    }


def main(folder: Path, changes: Path) -> int:
    """Compute and compare; returns how many files differ."""
    # Without PYTHONPATH: each copy runs its own code.
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    sums = []
    for jobs in ("-j1", "-j2"):
        root = folder / jobs[1:]
        copy_checkout(ROOT, root, changes)
        with (root / "verify.log").open("w") as log:
            command = ["snakemake", jobs, "all"]
            subprocess.run(command, cwd=root, env=environment, stdout=log, stderr=log, check=True)
        sums.append(checksums(root))
    one, two = sums
    differing = sorted(name for name in {*one, *two} if one.get(name) != two.get(name))
    for name, checksum in one.items():
        sys.stdout.write(f"{checksum}  {name}  {'differs' if name in differing else 'equal'}\n")
    sys.stdout.write(f"{len({*one, *two})} files, {len(differing)} differ: {differing}\n")
    return len(differing)


if __name__ == "__main__":
    target, *given = map(Path, sys.argv[1:])
    target.mkdir(parents=True)  # must not exist: both runs start from nothing
    (target / "none.yaml").write_text("{}\n")
    sys.exit(bool(main(target.resolve(), *(given or [target / "none.yaml"]))))
