"""What commands refuse before they compute anything."""

from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import pytest

from grasptypes.__main__ import main
from grasptypes.commands import plan, predict
from grasptypes.commands.settings import check_place, check_target, folder_params
from grasptypes.errors import InputError


def test_the_parameters_of_a_checkout_are_checked(tmp_path):
    assert folder_params(Path()).folds.count == 5
    with pytest.raises(InputError, match=r"params\.yaml.*--folder"):
        folder_params(tmp_path)
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
        (tmp_path / "file" / "picture.png", "file is no folder to write to"),
        (Path("/proc/new/picture.png"), "/proc is no folder to write to"),
    ):
        with pytest.raises(InputError, match=reason):
            check_target(target, ".png")
    check_target(tmp_path / "new" / "picture.PNG", ".png")
    assert not (tmp_path / "new").exists()


def test_a_disk_that_fills_up_meanwhile_costs_one_line(monkeypatch):
    def run(_):
        Path("/dev/full").write_text("a picture")

    monkeypatch.setattr(predict, "run", run)
    with pytest.raises(SystemExit) as end:
        main(["predict", "--image", "cup.png"])
    assert str(end.value) == "error: No space left on device"


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (MemoryError(), "error: the memory is too short"),
        (BrokenProcessPool(), "error: the memory is too short"),
        (KeyboardInterrupt(), "130"),
    ],
)
def test_a_command_that_is_cut_off_ends_without_a_trace(monkeypatch, error, status):
    def run(_):
        raise error

    monkeypatch.setattr(predict, "run", run)
    with pytest.raises(SystemExit) as end:
        main(["predict", "--image", "cup.png"])
    assert str(end.value.code).startswith(status)


def test_other_errors_of_a_command_are_not_swallowed(monkeypatch):
    def run(_):
        raise RuntimeError("a mistake of ours")

    monkeypatch.setattr(predict, "run", run)
    with pytest.raises(RuntimeError, match="ours"):
        main(["predict", "--image", "cup.png"])


def test_names_that_are_too_long_are_found_at_once(tmp_path):
    for name in ("x" * 250, "new/" + "x" * 300, "x" * 300 + "/new"):
        with pytest.raises(InputError, match="the name is too long"):
            check_place(tmp_path / name)
    check_place(tmp_path / "x" / "x" / "x")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_of_plans_that_cannot_be_copied_is_named(tmp_path):
    (tmp_path / "written").mkdir()
    (tmp_path / "written" / "plan.json").symlink_to("nowhere")
    with pytest.raises(InputError, match=r"out: cannot be written: .*No such file"):
        plan._move(tmp_path / "written", tmp_path / "out")
    assert [path.name for path in tmp_path.iterdir()] == ["written"]
