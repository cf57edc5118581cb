"""Checkouts and environments in folders whose names a shell, make or Snakemake could misread."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from repository import ROOT, Repository

NAME = 'a space; [b] (c) & umläut, it\'s"quoted" $HOME #1'
TARGET = "data/contact_maps/mug/use.npz"


def environment(folder: Path) -> Path:
    """A virtual environment in this folder that finds the packages of the one that runs tests."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    packages = f"lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages"
    (folder / packages / "others.pth").write_text(f"{sys.prefix}/{packages}\n")
    return folder / "bin"


def test_jobs_start_whatever_the_path(fresh: Repository, tmp_path: Path) -> None:
    repository = fresh.copy(tmp_path / NAME / "checkout")
    python = environment(tmp_path / NAME / "venv") / "python"
    repository.run(str(python), "-m", "snakemake", "-j1", TARGET)
    assert (repository.path / TARGET).is_file()


@pytest.mark.parametrize("venv", ["elsewhere/.venv", "a space/.venv"])
def test_make_takes_an_environment_at_a_relative_path(
    fresh: Repository, tmp_path: Path, venv: str
) -> None:
    repository = fresh.copy(tmp_path / "it's a [checkout]")
    tools = environment(repository.path / venv)
    (tools / "snakemake").write_text("#!/bin/sh\necho snakemake of $(dirname $0)\n")
    (tools / "snakemake").chmod(0o755)
    said = repository.run("make", "-s", "-o", "setup", "table1", f"VENV={venv}")
    assert said.startswith("snakemake of ")


def test_braces_in_the_path_of_a_checkout_are_refused(fresh: Repository, tmp_path: Path) -> None:
    repository = fresh.copy(tmp_path / "{a}")
    for command in (["snakemake", "-n"], ["make", "setup"]):
        output = repository.run(*command, check=False)
        assert "braces as wildcards" in output
        assert "Traceback" not in output


@pytest.mark.parametrize("name", ["a:b", "a $b", "a \\b"])
def test_an_impossible_place_is_refused_before_anything_is_set_up(name: str) -> None:
    called = subprocess.run(
        ["make", "-s", "setup", f"VENV=/nowhere/{name}"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "LC_ALL": "C.UTF-8"},
    )
    assert called.returncode != 0
    assert called.stderr.startswith(f"error: no virtual environment can lie in '/nowhere/{name}'")
    assert called.stdout == ""
