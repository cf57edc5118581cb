import subprocess
from pathlib import Path

import pytest
import yaml

from grasptypes.errors import InputError
from grasptypes.versions.checkout import copy_checkout


@pytest.fixture
def source(tmp_path: Path) -> Path:
    root = tmp_path / "source"
    (root / "data").mkdir(parents=True)
    (root / "params.yaml").write_text("seed: 0\nobjects: {scale: 1.15, names: [mug, pan]}\n")
    (root / "Snakefile").write_text("# rules\n")
    (root / "data" / "grasps.csv").write_text("Index\n")
    subprocess.run(["git", "init", "-q", root], check=True)
    return root


def test_copy_has_the_code_and_the_changed_params_but_no_results(
    source: Path, tmp_path: Path
) -> None:
    changes = tmp_path / "small.yaml"
    changes.write_text("objects: {names: [mug]}\n")
    copy_checkout(source, tmp_path / "copy", changes)
    assert (tmp_path / "copy" / "Snakefile").read_text() == "# rules\n"
    assert not (tmp_path / "copy" / "data").exists()
    params = yaml.safe_load((tmp_path / "copy" / "params.yaml").read_text())
    assert params == {"seed": 0, "objects": {"scale": 1.15, "names": ["mug"]}}


def test_results_in_the_target_stay(source: Path, tmp_path: Path) -> None:
    changes = tmp_path / "small.yaml"
    changes.write_text("seed: 1\n")
    (tmp_path / "copy" / "data").mkdir(parents=True)
    (tmp_path / "copy" / "data" / "old.npz").write_bytes(b"old")
    copy_checkout(source, tmp_path / "copy", changes)
    assert (tmp_path / "copy" / "data" / "old.npz").read_bytes() == b"old"


def test_a_folder_that_is_no_checkout_is_named(tmp_path: Path) -> None:
    changes = tmp_path / "small.yaml"
    changes.write_text("seed: 1\n")
    with pytest.raises(InputError, match="not a git checkout"):
        copy_checkout(tmp_path, tmp_path / "copy", changes)
