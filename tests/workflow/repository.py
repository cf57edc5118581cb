"""A complete small repository that tests can change: the workflow, DVC and git, run for real."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import yaml

from grasptypes.versions.checkout import copy_checkout

ROOT = Path(__file__).parents[2]
SMALL = ROOT / "tests" / "small.yaml"
TARGET = "reports/table1.csv"


class Repository:
    """A git checkout with DVC and Snakemake at work in it."""

    def __init__(self, path: Path) -> None:
        self.path = path

    @classmethod
    def create(cls, path: Path, settings: Path = SMALL) -> Repository:
        """A small configuration, committed, nothing computed yet."""
        copy_checkout(ROOT, path, settings)
        (path / "dvc.lock").unlink(missing_ok=True)
        copy_compiled(ROOT / "src", path / "src")
        repository = cls(path)
        repository.git("init", "-q", "-b", "main", ".")
        repository.commit("Start")
        return repository

    def copy(self, path: Path) -> Repository:
        """A copy with everything in it, DVC's cache and Snakemake's records too."""
        shutil.copytree(self.path, path, symlinks=True)
        return Repository(path)

    def lose(self, *names: str) -> Repository:
        """Remove results, which a run then has to make again; names may hold wildcards."""
        for name in names:
            for path in self.path.glob(name):
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        return self

    def run(self, *command: str, check: bool = True, **environment: str) -> str:
        """Run a command and return what it printed; a failure shows it all."""
        result = subprocess.run(
            command,
            cwd=self.path,
            env={**self.environment(), **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        assert not check or result.returncode == 0, f"{command}:\n{result.stdout}"
        return result.stdout

    @staticmethod
    def environment() -> dict[str, str]:
        tools = str(Path(sys.executable).parent)
        identity = {
            f"GIT_{role}_{what}": value
            for role in ("AUTHOR", "COMMITTER")
            for what, value in (("NAME", "test"), ("EMAIL", "test@example.org"))
        }
        kept = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        path = os.pathsep.join([tools, os.environ["PATH"]])
        return {**kept, **identity, "PATH": path, "DVC_NO_ANALYTICS": "1"}

    def git(self, *arguments: str) -> str:
        return self.run("git", *arguments)

    def dvc(self, *arguments: str) -> str:
        return self.run("dvc", *arguments)

    def snakemake(self, *arguments: str) -> str:
        return self.run("snakemake", "-j2", *(arguments or (TARGET,)))

    def module(self, *arguments: str) -> str:
        """What `python -m` prints."""
        return self.run("python", "-m", *arguments, PYTHONPATH=str(self.path / "src"))

    def planned(self, *targets: str) -> Counter[str]:
        """The jobs a dry run announces; it shows its table twice."""
        output = self.run("snakemake", "-n", *targets)
        return jobs(output[max(output.rfind("Job stats"), 0) :])

    def commit(self, message: str) -> None:
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", message)

    def set_param(self, key: str, value: Any) -> None:
        """Change one value of params.yaml, named by its dotted key."""
        path = self.path / "params.yaml"
        params = yaml.safe_load(path.read_text())
        *parents, last = key.split(".")
        section = params
        for parent in parents:
            section = section[parent]
        section[last] = value
        path.write_text(yaml.safe_dump(params, sort_keys=False))

    def snakemake_is_clean(self, target: str = TARGET) -> bool:
        return "Nothing to be done" in self.run("snakemake", "-n", target)

    def is_clean(self) -> bool:
        """Whether both tools have nothing to do."""
        return self.snakemake_is_clean("all") and self.dvc_is_clean()

    def dvc_is_clean(self) -> bool:
        return "up to date" in self.dvc("status")


def copy_compiled(source: Path, target: Path) -> None:
    """Copy what Python and Numba have compiled of a folder's modules, for jobs of a copy of it.

    Both compare it with the modules, so that what is stale is compiled anew.
    """
    for pattern in ("*.pyc", "*.nbi", "*.nbc"):  # indices before what they list
        for path in source.rglob(pattern):
            copied = target / path.relative_to(source)
            copied.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, copied)


def jobs(output: str) -> Counter[str]:
    """How many jobs of each rule a run of Snakemake, or several in one output, announced."""
    counts: Counter[str] = Counter()
    in_table = False
    for line in output.splitlines():
        row = re.fullmatch(r"(\w+)\s+(\d+)", line.strip())
        if line.startswith("job ") and "count" in line:
            in_table = True
        elif in_table and row and row[1] != "total":
            counts[row[1]] += int(row[2])
        elif in_table and (not line.strip() or (row and row[1] == "total")):
            in_table = False
    return counts
