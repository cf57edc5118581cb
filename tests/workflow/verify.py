"""Compute everything twice from nothing, with one job and with two at a time, and compare.

``python tests/workflow/verify.py FOLDER`` does it for params.yaml as it stands, ``--params
tests/small.yaml`` for the small configuration. It prints every file's checksum and whether both
runs made it; the exit status is 1 if any differs.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from grasptypes.files import write_text
from grasptypes.versions.checkout import copy_checkout

ROOT = Path(__file__).parents[2]
RESULTS = ("data", "models", "reports")


def checksums(root: Path) -> dict[str, str]:
    """Every file of the results and its SHA-256."""
    paths = sorted(path for name in RESULTS for path in (root / name).rglob("*") if path.is_file())
    return {
        str(path.relative_to(root)): hashlib.sha256(path.read_bytes()).hexdigest() for path in paths
    }


def compute(root: Path, changes: Path, jobs: int, targets: Sequence[str]) -> dict[str, str]:
    """Run the workflow in a new copy of this checkout; returns the results' checksums."""
    copy_checkout(ROOT, root, changes)
    begun = time.monotonic()
    with (root / "verify.log").open("w") as log:
        command = ["snakemake", f"-j{jobs}", *targets]
        subprocess.run(command, cwd=root, env=environment(), stdout=log, stderr=log, check=True)
    sys.stdout.write(f"# {root}: -j{jobs}, {time.monotonic() - begun:.0f} s\n")
    return checksums(root)


def environment() -> dict[str, str]:
    """Without PYTHONPATH: each copy runs its own code."""
    return {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}


def report(one: Mapping[str, str], two: Mapping[str, str]) -> tuple[str, int]:
    """A line a file, and how many are not the same in both."""
    lines, differing = [], 0
    for name in sorted({*one, *two}):
        first, second = one.get(name, "missing"), two.get(name, "missing")
        equal = first == second
        differing += not equal
        lines.append(f"{first}  {name}  " + ("equal" if equal else f"differs: {second}"))
    lines.append(f"{len(lines) - differing} of {len(lines)} files are equal")
    return "\n".join(lines) + "\n", differing


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="must not exist yet")
    parser.add_argument("--params", type=Path, help="YAML file laid over params.yaml")
    parser.add_argument("--targets", nargs="*", default=["all"])
    asked = parser.parse_args()
    if asked.folder.exists():
        sys.exit(f"error: {asked.folder}: is there already; both runs must start from nothing")
    changes = asked.params or asked.folder / "no_changes.yaml"
    if not asked.params:
        write_text(changes, "{}\n")
    sums = [compute(asked.folder / f"jobs_{jobs}", changes, jobs, asked.targets) for jobs in (1, 2)]
    text, differing = report(*sums)
    sys.stdout.write(text)
    sys.exit(bool(differing))


if __name__ == "__main__":
    main()
