"""Copies of a checkout: its code with other parameters, and none of its results."""

import subprocess
from pathlib import Path

import pytest
import yaml

from grasptypes.errors import InputError
from grasptypes.versions.checkout import copy_checkout


def test_a_copy_has_the_code_and_the_changed_params_and_keeps_its_own_results(
    tmp_path: Path,
) -> None:
    source, target, changes = (tmp_path / name for name in ("source", "copy", "changes.yaml"))
    for path, text in {
        source / "params.yaml": "seed: 0\nobjects: {scale: 1.15, names: [mug, pan]}\n",
        source / "Snakefile": "# rules\n",
        source / ".gitignore": "/data/\n",
        source / "data/grasps.csv": "Index\n",
        target / "data/old.npz": "old",
        changes: "objects: {names: [mug]}\n",
    }.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    subprocess.run(["git", "init", "-q", source], check=True)
    copy_checkout(source, target, changes)
    assert (target / "Snakefile").read_text() == "# rules\n"
    assert [path.name for path in (target / "data").iterdir()] == ["old.npz"]
    params = yaml.safe_load((target / "params.yaml").read_text())
    assert params == {"seed": 0, "objects": {"scale": 1.15, "names": ["mug"]}}


def test_what_git_refuses_is_said_in_its_words(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(InputError, match="git says: fatal: not a git repository"):
        copy_checkout(tmp_path, tmp_path / "copy", tmp_path / "changes.yaml")
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")  # no safe.directory
    with pytest.raises(InputError, match=r"dubious ownership.*git config --global --add safe"):
        copy_checkout(tmp_path, tmp_path / "copy", tmp_path / "changes.yaml")
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match="git: is not installed"):
        copy_checkout(tmp_path, tmp_path / "copy", tmp_path / "changes.yaml")
    with pytest.raises(InputError, match="gone: no such folder"):
        copy_checkout(tmp_path / "gone", tmp_path / "copy", tmp_path / "changes.yaml")
    assert not (tmp_path / "copy").exists()
