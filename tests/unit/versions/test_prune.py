import base64
from pathlib import Path

import pytest

from grasptypes.versions.prune import prune

FILES = (
    "data/objects/mug/visual.glb",
    "data/objects/pan/visual.glb",
    "data/contact_maps/mug/use.npz",
    "data/contact_maps/mug/handoff.npz",
    "data/grasps/pan/use.parquet",
    "data/renders/mug.zip",
    "data/renders/pan.zip",
    "data/features/pan.npz",
    "data/samples.csv",
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
    gone = prune(root, ["mug"], ["use", "handoff"])
    assert [str(path) for path in gone] == sorted(name for name in FILES if "pan" in name)
    for name in FILES:
        assert (root / name).exists() == ("pan" not in name), name
        assert record(root, name).exists() == ("pan" not in name), name
    assert not (root / "data/objects/pan").exists()


def test_a_removed_task_leaves_nothing_behind(root: Path) -> None:
    gone = prune(root, ["mug", "pan"], ["use"])
    assert [str(path) for path in gone] == ["data/contact_maps/mug/handoff.npz"]
    assert prune(root, ["mug", "pan"], ["use"]) == []


def test_long_paths_are_recorded_in_several_parts(tmp_path: Path) -> None:
    name = f"data/objects/{'x' * 200}/visual.glb"
    encoded = base64.urlsafe_b64encode(name.encode()).decode()
    split = tmp_path / ".snakemake/metadata" / f"@{encoded[:254]}" / encoded[254:]
    for path in (tmp_path / name, split):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("")
    assert prune(tmp_path, ["mug"], ["use"]) == [Path(name)]
    assert not split.exists()
