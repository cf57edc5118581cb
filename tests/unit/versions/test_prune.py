import base64
import os
import shutil
from pathlib import Path

import pytest

from grasptypes.versions.guard import FolderLock
from grasptypes.versions.prune import main, prune

BOTH = ["simulated", "published"]
FILES = (
    "data/objects/mug/visual.glb",
    "data/objects/pan/visual.glb",
    "data/contact_maps/mug/use.npz",
    "data/contact_maps/mug/handoff.npz",
    "data/grasps/pan/use.parquet",
    "data/renders/mug.zip",
    "data/renders/pan.zip",
    "data/features/pan.npz",
    "data/generalisation/features/pan.npz",
    "data/generalisation/published/no_task.csv",
    "data/samples.csv",
    "models/simulated/no_task/predictor.json",
    "models/published/no_task/predictor.json",
    "reports/scores/grasps.json",
    "reports/scores/published/no_task.json",
    "reports/figures/contact_maps/pan_use.png",
    "reports/figures/contact_maps/mug_use.png",
    "reports/figures/table1.png",
)


def record(root: Path, output: str) -> Path:
    return root / ".snakemake/metadata" / base64.urlsafe_b64encode(output.encode()).decode()


@pytest.fixture
def root(tmp_path: Path) -> Path:
    for name in FILES:
        for path in (tmp_path / name, record(tmp_path, name)):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(name)
    return tmp_path


def test_a_removed_object_leaves_nothing_behind(root: Path) -> None:
    gone = prune(root, ["mug"], ["use", "handoff"], BOTH)
    assert [str(path) for path in gone] == sorted(name for name in FILES if "pan" in name)
    for name in FILES:
        assert (root / name).exists() == ("pan" not in name), name
        assert record(root, name).exists() == ("pan" not in name), name
    assert not (root / "data/objects/pan").exists()


def test_a_removed_task_leaves_nothing_behind(root: Path) -> None:
    gone = prune(root, ["mug", "pan"], ["use"], BOTH)
    assert [str(path) for path in gone] == ["data/contact_maps/mug/handoff.npz"]
    assert prune(root, ["mug", "pan"], ["use"], BOTH) == []


def test_a_label_source_that_is_taken_out_leaves_no_models_behind(root: Path) -> None:
    gone = prune(root, ["mug", "pan"], ["use", "handoff"], ["simulated"])
    assert [str(path) for path in gone] == sorted(name for name in FILES if "/published/" in name)
    assert not (root / "models/published").exists()
    assert (root / "reports/scores/grasps.json").exists()


def test_nothing_is_deleted_while_another_run_is_at_work(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    project = Path(__file__).parents[3]
    (root / "params.yaml").write_bytes((project / "params.yaml").read_bytes())
    shutil.copytree(project / "workflow/schemas", root / "workflow/schemas")
    (root / "data/objects/gone").mkdir()
    (root / "data/objects/gone/visual.glb").touch()
    monkeypatch.chdir(root)
    other = FolderLock()
    assert other.take()
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 1
    assert capsys.readouterr().err == f"another run holds this folder: process {os.getpid()}\n"
    assert (root / "data/objects/gone/visual.glb").exists()
    del other
    main()
    assert not (root / "data/objects/gone").exists()
    assert (root / "data/objects/mug").exists()


def test_long_paths_are_recorded_in_several_parts(tmp_path: Path) -> None:
    name = f"data/objects/{'x' * 200}/visual.glb"
    encoded = base64.urlsafe_b64encode(name.encode()).decode()
    split = tmp_path / ".snakemake/metadata" / f"@{encoded[:254]}" / encoded[254:]
    for path in (tmp_path / name, split):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("")
    assert prune(tmp_path, ["mug"], ["use"], BOTH) == [Path(name)]
    assert not split.exists()
