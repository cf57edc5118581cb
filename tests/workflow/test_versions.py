"""Snakemake and DVC agree on what is stale, whoever is asked and wherever the files come from."""

import re
import shutil
from pathlib import Path

import pytest
from repository import TARGET, Repository


def test_a_clone_that_pulls_has_nothing_to_do(changed: Repository, tmp_path: Path) -> None:
    changed.dvc("remote", "add", "-d", "store", str(tmp_path / "store"))
    changed.commit("Remote")
    changed.dvc("push")
    changed.git("clone", "-q", ".", str(tmp_path / "clone"))
    clone = Repository(tmp_path / "clone")
    clone.dvc("pull")
    assert clone.snakemake_is_clean("all")
    assert clone.dvc_is_clean()
    part = clone.path / "data/renders"
    shutil.rmtree(part)
    assert clone.snakemake_is_clean()


def test_a_clone_that_does_not_pull_computes_what_git_holds_tables_of(
    fresh: Repository, changed: Repository, tmp_path: Path
) -> None:
    changed.git("clone", "-q", ".", str(tmp_path / "clone"))
    clone = Repository(tmp_path / "clone")
    assert (clone.path / "reports/table1.csv").exists()
    assert clone.planned(TARGET) == fresh.planned(TARGET)
    clone.snakemake("data/folds.csv")
    planned = clone.planned(TARGET)
    assert planned["train_predictor"] == fresh.planned(TARGET)["train_predictor"]
    assert planned["split_folds"] == planned["render_object"] == 0


@pytest.mark.parametrize(
    ("key", "value", "first", "untouched"),
    [
        ("predictors.epochs", 7, "train_predictor", "extract_features"),
        ("renders.fill", 0.8, "render_object", "synthesize_grasps"),
        ("grasp_types.thresholds.large_span_m", 0.08, "label_grasps", "synthesize_grasps"),
        ("contact_maps.threshold", 0.41, "map_contacts", "render_object"),
    ],
)
def test_a_changed_parameter_is_noticed_by_both(
    changed: Repository, key: str, value: float, first: str, untouched: str
) -> None:
    changed.set_param(key, value)
    planned = changed.planned("all")
    assert planned[first] > 0
    assert planned[untouched] == 0
    assert not changed.dvc_is_clean()


def test_a_changed_module_reruns_what_imports_it_and_a_comment_nothing(
    changed: Repository,
) -> None:
    module = changed.path / "src/grasptypes/labels/grasp_type.py"
    text = module.read_text()
    module.write_text(text + "\n# A remark.\n")
    assert changed.snakemake_is_clean("all")
    module.write_text(text + "\nUNUSED = 1\n")
    planned = changed.planned("all")
    assert planned["label_grasps"] == 1
    assert planned["render_object"] == planned["prepare_object"] == 0
    assert not changed.dvc_is_clean()


def test_touching_every_file_changes_nothing(changed: Repository) -> None:
    changed.run("bash", "-c", "find data reports models src workflow -type f | xargs touch")
    assert changed.snakemake_is_clean("all")
    assert changed.dvc_is_clean()


def test_a_removed_object_leaves_nothing_behind(changed: Repository) -> None:
    changed.set_param("objects.names", ["banana"])
    planned = changed.planned("data/samples.csv")
    assert planned["label_grasps"] == 1
    assert planned["prepare_object"] == planned["synthesize_grasps"] == 0
    changed.run("python", "-m", "grasptypes.versions.prune", PYTHONPATH=str(changed.path / "src"))
    left = [path for path in changed.path.glob("data/**/*mug*")]
    assert left == []


def test_a_hand_edited_result_is_found_with_its_cure(changed: Repository) -> None:
    edited = "data/grasps/mug/use.parquet"
    (changed.path / edited).write_bytes(
        (changed.path / "data/grasps/mug/handoff.parquet").read_bytes()
    )
    doctor = ("python", "-m", "grasptypes.versions.doctor")
    source = str(changed.path / "src")
    found = changed.run(*doctor, check=False, PYTHONPATH=source)
    assert f"dvc checkout --force {edited}" in found
    changed.dvc("checkout", "--force", edited)
    assert "nothing is wrong" in changed.run(*doctor, PYTHONPATH=source)


def test_dvc_shows_scores_stages_and_pictures_offline(changed: Repository) -> None:
    scores = changed.dvc("metrics", "show")
    assert "reports/scores/simulated/task_vector.json" in scores
    assert "unseen.similarity" in scores
    assert "predictors" in changed.dvc("dag")
    changed.set_param("renders.fill", 0.8)
    assert "renders.fill" in changed.dvc("params", "diff")
    changed.dvc("plots", "show")
    page = changed.path / "build/dvc_plots/index.html"
    text = page.read_text()
    assert "http" not in text, "the page asks the network for something"
    pictures = re.findall(r'<img src="([^"]+)"', text)
    assert len(pictures) > 5
    assert all((page.parent / picture).is_file() for picture in pictures)
