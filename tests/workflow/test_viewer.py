"""The viewer in a real browser, without a network; screenshots are in pytest's temporary folder."""

from __future__ import annotations

import io
import signal
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import trimesh

pytest.importorskip("selenium", reason="no selenium: pip install -e .[dev]")
from browser import browser, foreign_hosts, missing_programs, wait_for
from PIL import Image
from selenium.webdriver import Chrome
from tests.unit.viewer_data import HAND, write_dataset

from grasptypes.__main__ import main
from grasptypes.files import write_text
from grasptypes.viewer.grasp_views import dataset_views
from grasptypes.viewer.page import page

# Chromium draws without a graphics card, for a time that grows with the pixels.
WINDOW_PX = (960, 640)
# The canvas between the panel and the legend.
BETWEEN = slice(360, 700)

pytestmark = pytest.mark.skipif(bool(missing_programs()), reason=missing_programs())

SHOWN = "document.body.dataset.shown"
CHOOSE = """const box = document.getElementById(arguments[0]);
box.value = arguments[1]; box.dispatchEvent(new Event('change'));"""
MOVE = """const bar = document.getElementById('moment');
bar.value = arguments[0]; bar.dispatchEvent(new Event('input'));"""
# What page.js draws contacts with.
POINT, FORCE = (0, 176, 80), (0, 87, 217)
LEGENDS = {"parts": "body (container_wall)", "contact map": "100 %"}
# The page has drawn what it was told before.
DRAWN = """const done = arguments[0];
requestAnimationFrame(() => requestAnimationFrame(() => done(true)));"""


@pytest.fixture(scope="module")
def dataset(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_dataset(tmp_path_factory.mktemp("data"))


@pytest.fixture(scope="module")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chrome]:
    with browser(tmp_path_factory.mktemp("profile")) as driver:
        driver.set_window_size(*WINDOW_PX)
        yield driver


def picture(driver: Chrome) -> np.ndarray:
    """What the canvas shows, without the panel: (H, W, 3)."""
    driver.execute_async_script(DRAWN)
    image = Image.open(io.BytesIO(driver.get_screenshot_as_png())).convert("RGB")
    return np.asarray(image)[:, BETWEEN].astype(int)


def coloured(shown: np.ndarray, rgb: tuple[int, int, int]) -> int:
    """Number of pixels of a colour that nothing else on the page has."""
    return int((np.abs(shown - rgb).sum(axis=2) < 40).sum())


def errors(driver: Chrome) -> list[str]:
    return [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]


def check_page(driver: Chrome, folder: Path) -> None:
    """Try the page as a user does."""
    assert wait_for(driver, SHOWN) == "can handoff 2"
    first = picture(driver)
    driver.save_screenshot(str(folder / "first.png"))
    assert (np.abs(first - first[2, 2]).sum(axis=2) > 30).mean() > 0.03, "the canvas is blank"
    assert "distal_2 5.0 N" in driver.find_element("id", "facts").text
    marks = (POINT, FORCE)
    assert all(coloured(first, rgb) > 20 for rgb in marks), "no contact points, or no forces"
    driver.find_element("id", "contacts-shown").click()
    assert not any(coloured(picture(driver), rgb) for rgb in marks)
    driver.find_element("id", "contacts-shown").click()
    driver.find_element("id", "next").click()
    assert wait_for(driver, f"{SHOWN} === 'can handoff 1'")
    second = picture(driver)
    assert np.abs(second - first).max() > 60
    for how in ("parts", "contact map"):
        driver.execute_script(CHOOSE, "colours", how)
        assert np.abs(picture(driver) - second).max() > 30, how
        assert LEGENDS[how] in driver.find_element("id", "legend").text
    closed = picture(driver)
    driver.execute_script(MOVE, 0)
    assert np.abs(picture(driver) - closed).max() > 60
    driver.find_element("id", "play").click()
    wait_for(driver, "document.getElementById('moment').value === '1'")
    assert np.array_equal(picture(driver), closed)
    driver.execute_script(CHOOSE, "object", "jar")
    driver.execute_script(CHOOSE, "task", "use")
    driver.execute_script(CHOOSE, "reason", "dropped")
    assert wait_for(driver, f"{SHOWN} === 'jar use 3'")
    text = driver.find_element("id", "facts").text
    assert "Invalid" in text
    assert "dropped" in text
    driver.save_screenshot(str(folder / "dropped.png"))
    assert errors(driver) == []
    assert foreign_hosts(driver) == set()


def test_the_page_opens_from_a_file(chromium: Chrome, dataset: Path, tmp_path: Path) -> None:
    write_text(tmp_path / "grasps.html", page(dataset_views(dataset, HAND)))
    chromium.get((tmp_path / "grasps.html").as_uri())
    check_page(chromium, tmp_path)


def test_an_inspected_mesh_shows_parts_and_contact_maps(chromium: Chrome, tmp_path: Path) -> None:
    mesh, table = tmp_path / "cup.stl", tmp_path / "roles.csv"
    trimesh.creation.annulus(0.035, 0.04, 0.1).export(mesh)
    table.write_text("part,role\nbody,container_wall\n")
    main(["inspect", str(mesh), "--roles", str(table), "--page", str(tmp_path / "cup.html")])
    chromium.get((tmp_path / "cup.html").as_uri())
    assert wait_for(chromium, SHOWN) == "cup use"
    parts = picture(chromium)
    assert (np.abs(parts - parts[2, 2]).sum(axis=2) > 30).mean() > 0.03, "the canvas is blank"
    assert "body (container_wall)" in chromium.find_element("id", "legend").text
    assert not chromium.find_element("id", "play").is_displayed()
    chromium.execute_script(CHOOSE, "colours", "contact map")
    used = picture(chromium)
    assert np.abs(used - parts).max() > 60
    chromium.execute_script(CHOOSE, "task", "handoff")
    assert wait_for(chromium, f"{SHOWN} === 'cup handoff'")
    assert np.abs(picture(chromium) - used).max() > 10
    assert errors(chromium) == []


def test_the_command_serves_it_on_this_machine(chromium: Chrome, dataset: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "grasptypes", "view", str(dataset), "--no-browser"],
        stdout=subprocess.PIPE,
        text=True,
        # Tests that run in the background ignore the key, and their children would, too.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        assert process.stdout is not None
        line = process.stdout.readline()
        assert "http://127.0.0.1:" in line
        address = line.split()[3]
        with urllib.request.urlopen(address) as answer:
            assert answer.read().decode() == page(dataset_views(dataset, HAND))
        chromium.get(address)
        assert wait_for(chromium, SHOWN) == "can handoff 2"
        assert errors(chromium) == []
        assert foreign_hosts(chromium) == set()
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(30) == 130
