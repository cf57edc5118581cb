"""What commands refuse before they compute anything."""

import shutil
from pathlib import Path

import pytest

from grasptypes.commands.settings import check_target, folder_params
from grasptypes.errors import InputError


def test_the_parameters_of_a_checkout_are_checked(tmp_path):
    assert folder_params(Path())["folds"]["count"] == 5
    with pytest.raises(InputError, match=r"params\.yaml.*--folder"):
        folder_params(tmp_path)
    shutil.copytree("workflow/schemas", tmp_path / "workflow/schemas")
    text = Path("params.yaml").read_text()
    (tmp_path / "params.yaml").write_text(text.replace("seed: 0", "seed: none"))
    with pytest.raises(InputError, match=r"params\.yaml: seed: 'none'"):
        folder_params(tmp_path)


def test_targets_that_could_not_be_written_are_refused(tmp_path):
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "file").touch()
    for target, reason in (
        (tmp_path / "picture.jpg", "must end in .png"),
        (tmp_path / "folder.png", "is a folder"),
        (tmp_path / "file" / "picture.png", "is not a folder"),
    ):
        with pytest.raises(InputError, match=reason):
            check_target(target, ".png")
    check_target(tmp_path / "new" / "picture.PNG", ".png")
    assert not (tmp_path / "new").exists()
