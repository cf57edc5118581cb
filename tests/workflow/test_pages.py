"""What a user looks at, in a real browser: the report and the MLflow UI, without a network.

Screenshots lie in pytest's temporary folder.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from repository import Repository

pytest.importorskip("selenium", reason="no selenium: pip install -e .[dev]")
from browser import (
    browser,
    click_text,
    foreign_hosts,
    make,
    missing_programs,
    served_folder,
    served_runs,
    wait_for,
)
from selenium.webdriver import Chrome

from grasptypes.predictors.metrics import METRICS

pytestmark = pytest.mark.skipif(bool(missing_programs()), reason=missing_programs())

LABELS = ("simulated", "published")
MODELS = ("no_task", "task_vector", "task_in_image", "ignores_task")
CATEGORIES = ["Folds", "Grasp types", "Grasps", "Objects", "Results", "Timing", "Unseen objects"]
# What shows a result in the list of a category; tables are downloaded instead.
VIEW = "[...document.querySelectorAll('nav tbody td > div')].map(d => d.firstChild)"
SHOWN = "[...document.querySelectorAll('img')].filter(i => i.closest('nav') === null)[0]"
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


def test_the_report_shows_every_figure_with_its_caption(
    changed: Repository, chromium: Chrome, tmp_path: Path
) -> None:
    changed.run(*make("report"), PYTHONPATH=str(changed.path / "src"))
    with served_folder(changed.path / "build") as address:
        chromium.get(f"{address}/report.html")
        wait_for(chromium, "document.body.innerText.includes('Which grasp should a robot')")
        chromium.save_screenshot(str(tmp_path / "report.png"))
        assert wait_for(chromium, "Object.keys(categories).sort()") == CATEGORIES
        without = "Object.entries(results).filter(([_, r]) => !r.caption.trim()).map(r => r[0])"
        assert chromium.execute_script(f"return {without}") == []
        shown = {name: _click_through(chromium, name, tmp_path) for name in CATEGORIES}
    assert sum(shown.values()) >= 16, shown
    assert foreign_hosts(chromium) == set()
    assert changed.snakemake_is_clean("all")
    assert changed.dvc_is_clean()


def _click_through(driver: Chrome, category: str, folder: Path) -> int:
    """Open every figure of a category; returns how many there are."""
    driver.execute_script("app.setView({navbarMode: 'menu'})")
    click_text(driver, category, "nav li a")
    parts = driver.execute_script("return Object.keys(categories[arguments[0]])", category)
    count = 0
    for part in parts:
        if len(parts) > 1:
            driver.execute_script("app.showCategory(arguments[0])", category)
            click_text(driver, part, "nav li a")
        figures = wait_for(driver, VIEW)
        for number, button in enumerate(figures):
            if button.get_attribute("download"):
                continue
            driver.execute_script("arguments[0].click()", button)
            wait_for(driver, f"({SHOWN} || {{}}).naturalWidth")
            name = f"{category} {part} {number}".replace("/", " ")
            driver.save_screenshot(str(folder / f"{name}.png"))
            count += 1
    return count


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
