"""The report and the MLflow UI in a real browser, without a network.

Screenshots are in pytest's temporary folder.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from repository import Repository

pytest.importorskip("selenium", reason="no selenium: pip install -e .[dev]")
from browser import (
    browser,
    foreign_hosts,
    make,
    missing_programs,
    served_runs,
    wait_for,
)
from selenium.webdriver import Chrome

from grasptypes.predictors.metrics import METRICS

pytestmark = pytest.mark.skipif(bool(missing_programs()), reason=missing_programs())

LABELS = ("simulated", "published")
MODELS = ("no_task", "task_vector", "task_in_image", "ignores_task", "e_mobilenet_v2")
CATEGORIES = ["Folds", "Grasp types", "Grasps", "Objects", "Results", "Timing", "Unseen objects"]
# The runs that the table of MLflow shows, and how many of them have a value for a metric.
RUNS = "[...document.querySelectorAll('[role=row] a')].filter(a => a.href.includes('/runs/'))"
NAMES = f"{RUNS}.map(a => a.innerText.trim())"
CELLS = """[...document.querySelectorAll('[role=gridcell]')].filter(
    c => c.getAttribute('col-id') === 'metrics.`' + arguments[0] + '`' && c.innerText.trim()
).length"""


@pytest.fixture(scope="module")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chrome]:
    with browser(tmp_path_factory.mktemp("profile")) as driver:
        yield driver


def test_the_report_shows_every_figure_with_its_caption_from_any_state(
    changed: Repository, chromium: Chrome, tmp_path: Path
) -> None:
    changed.lose("reports/table1_published.*", "reports/figures/table1_published.png")
    changed.run(*make("report"), PYTHONPATH=str(changed.path / "src"))
    chromium.get((changed.path / "build/report.html").as_uri())
    wait_for(chromium, "document.body.innerText.includes('Which grasp should a robot')")
    chromium.save_screenshot(str(tmp_path / "report.png"))
    assert wait_for(chromium, "Object.keys(categories).sort()") == CATEGORIES
    without = "Object.entries(results).filter(([_, r]) => !r.caption.trim()).map(r => r[0])"
    assert chromium.execute_script(f"return {without}") == []
    figures = "Object.values(results).filter(r => r.mime_type.startsWith('image')).length"
    assert wait_for(chromium, figures) >= 16
    assert foreign_hosts(chromium) == set()
    assert changed.is_clean()


def test_the_runs_fold_below_their_models_and_show_the_measures(
    changed: Repository, chromium: Chrome, tmp_path: Path
) -> None:
    models = sorted(f"{labels} {model}" for labels in LABELS for model in MODELS)
    folds = [f"fold {fold}, seed 0" for fold in range(2)]
    with served_runs(changed) as link:
        chromium.get(link)
        wait_for(chromium, f"{RUNS}.length >= arguments[0]", len(models))
        assert sorted(chromium.execute_script(f"return {NAMES}")) == models
        for measure in METRICS:
            assert chromium.execute_script(f"return {CELLS}", measure) == len(models), measure
        chromium.save_screenshot(str(tmp_path / "runs.png"))

        unfold = f"{RUNS}[0].closest('[role=row]').querySelector('button').click()"
        chromium.execute_script(unfold)
        wait_for(chromium, f"{RUNS}.length > arguments[0]", len(models))
        assert sorted(chromium.execute_script(f"return {NAMES}")) == sorted(models + folds)
        chromium.save_screenshot(str(tmp_path / "folds.png"))

        chromium.execute_script(f"{RUNS}[0].click()")
        wait_for(chromium, "document.body.innerText.includes('Child runs')")
        text = chromium.execute_script("return document.body.innerText")
        assert all(measure in text for measure in METRICS)
        chromium.save_screenshot(str(tmp_path / "run.png"))
    assert foreign_hosts(chromium) == set()
