"""Snakemake and DVC agree on what is stale, wherever the files come from."""

import os
import re
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from repository import TARGET, Repository, jobs
from verify import RESULTS, checksums

# Two models and what was measured of them: two jobs at a time, and the tables after them.
LOST = [
    f"{folder}/simulated/{model}*"
    for folder in ("models", "reports/metrics", "reports/loss_curves")
    for model in ("no_task", "task_vector")
]


def test_both_tools_have_nothing_to_do_and_git_sees_no_results(complete: Repository) -> None:
    assert complete.is_clean()
    assert jobs(complete.dvc("repro")) == {}
    assert complete.git("status", "--porcelain") == ""


def test_a_clone_that_pulls_has_nothing_to_do_and_notices_changes(
    changed: Repository, tmp_path: Path
) -> None:
    changed.dvc("remote", "add", "-d", "store", str(tmp_path / "store"))
    changed.commit("Remote")
    changed.dvc("push")
    changed.git("clone", "-q", ".", str(tmp_path / "clone"))
    clone = Repository(tmp_path / "clone")
    assert clone.planned(TARGET) == changed.copy(tmp_path / "none").lose(*RESULTS).planned(TARGET)
    clone.dvc("pull")
    assert clone.is_clean()
    assert jobs(clone.dvc("repro")) == {}
    assert clone.git("status", "--porcelain") == ""
    assert checksums(clone.path) == checksums(changed.path)
    clone.set_param("predictors.epochs", 7)
    planned = clone.planned(TARGET)
    assert planned["train_predictor"] == 5
    assert planned["extract_features"] == 0
    clone.set_param("predictors.epochs", 6)
    assert clone.lose("data/renders").snakemake_is_clean()


def round_scores(repository: Repository) -> None:
    module = repository.path / "src/grasptypes/reports/scores.py"
    text = module.read_text()
    assert "\nDIGITS = 4" in text
    module.write_text(text.replace("\nDIGITS = 4", "\nDIGITS = 1"))


def train_longer(repository: Repository) -> None:
    repository.set_param("predictors.epochs", 7)


@pytest.mark.parametrize(
    ("change", "rule", "count"),
    [
        (round_scores, "summarise_scores", 1),
        pytest.param(train_longer, "train_predictor", 10, marks=pytest.mark.slow),
    ],
)
def test_versions_come_and_go_with_git_and_metrics_are_compared(
    changed: Repository, change: Callable[[Repository], None], rule: str, count: int
) -> None:
    change(changed)
    assert jobs(changed.dvc("repro"))[rule] == count
    assert changed.snakemake_is_clean("all")
    changed.commit("Changed")
    compared = changed.dvc("metrics", "diff", "HEAD~1", "HEAD")
    assert "reports/scores/simulated/task_vector.json" in compared
    for version in ("HEAD~1", "main"):
        changed.git("checkout", "-q", version)
        changed.dvc("checkout")
        assert changed.is_clean()
    changed.set_param("renders.sheet.views", 2)
    assert changed.planned("all") == {"plot_renders": 1, "all": 1}


def test_an_experiment_elsewhere_makes_only_what_it_changes(changed: Repository) -> None:
    before = (changed.path / "dvc.lock").read_bytes()
    output = changed.dvc("exp", "run", "--temp", "-n", "tall", "-S", "renders.sheet.views=3")
    assert jobs(output).keys() - {"all", "renders", "results"} == {"plot_renders"}
    assert (changed.path / "dvc.lock").read_bytes() == before
    assert changed.is_clean()


def test_touching_every_file_changes_nothing(changed: Repository) -> None:
    changed.run("bash", "-c", "find data reports models src workflow -type f | xargs touch")
    assert changed.is_clean()


def test_a_removed_object_is_listed(changed: Repository) -> None:
    changed.set_param("objects.names", ["banana"])
    planned = changed.planned("data/samples.csv")
    assert planned["label_grasps"] == 1
    assert planned["prepare_object"] == planned["synthesize_grasps"] == 0
    listed = changed.run("snakemake", "all", "--list-untracked").splitlines()
    left = {str(path.relative_to(changed.path)) for path in changed.path.glob("data/**/*mug*/*")}
    assert left
    assert left <= set(listed)


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


@pytest.mark.parametrize(
    "command",
    [
        ("dvc", "repro"),  # it runs Snakemake
        pytest.param(("snakemake", "-j2", "predictors", "all"), marks=pytest.mark.slow),
    ],
    ids=" ".join,
)
def test_a_second_run_is_refused_and_a_killed_one_goes_on(
    changed: Repository, complete: Repository, command: tuple[str, ...]
) -> None:
    changed.lose(*LOST)
    log = changed.path.parent / "run.log"
    with log.open("w") as output:
        first = subprocess.Popen(
            command,
            cwd=changed.path,
            env=changed.environment(),
            stdout=output,
            stderr=output,
            start_new_session=True,
        )
    try:
        while "Training" not in log.read_text():
            assert first.poll() is None, log.read_text()
            time.sleep(0.1)
        # It stands still in the middle of a job, however fast the machine is.
        os.killpg(first.pid, signal.SIGSTOP)
        said = changed.run("snakemake", "-j2", check=False)
        assert re.search(r"another run is active in this folder: process \d+", said)
        assert "Execute" not in said
        # A dry run reads along.
        assert "Job stats" in changed.run("snakemake", "-n", "predictors", "all")
    finally:
        os.killpg(first.pid, signal.SIGKILL)
        first.wait()
    changed.run(*command)
    assert checksums(changed.path) == checksums(complete.path)
    changed.dvc("repro")
    assert changed.is_clean()
