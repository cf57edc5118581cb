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

pytestmark = pytest.mark.skipif(bool(missing_programs()), reason=missing_programs())

MODELS = ("no_task", "task_vector", "task_in_image", "ignores_task")
CATEGORIES = ["Folds", "Grasp types", "Grasps", "Objects", "Results", "Timing", "Unseen objects"]
# What shows a result in the list of a category; tables are downloaded instead.
VIEW = "[...document.querySelectorAll('nav tbody td > div')].map(d => d.firstChild)"
SHOWN = "[...document.querySelectorAll('img')].filter(i => i.closest('nav') === null)[0]"
RUNS = "[...document.querySelectorAll('[role=row] a')].filter(a => a.href.includes('/runs/'))"


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
    complete: Repository, chromium: Chrome, tmp_path: Path
) -> None:
    with served_runs(complete) as link:
        chromium.get(link)
        parents = [
            f"{s} {m}"
            for s in ("simulated", "published")
            for m in ("no_task", "task_in_image", "task_vector", "ignores_task")
        ]
        wait_for(chromium, f"{RUNS}.length >= {len(parents)}")
        names = chromium.execute_script(f"return {RUNS}.map(a => a.innerText.trim())")
        chromium.save_screenshot(str(tmp_path / "runs.png"))
        assert sorted(filter(None, names)) == sorted(parents)
    assert foreign_hosts(chromium) == set()
